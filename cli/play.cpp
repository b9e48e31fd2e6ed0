/// play: shows animations in the browser, alone or beside their original.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/figures.h"
#include "cli/reel_file.h"
#include "cli/source.h"
#include "cli/verb.h"
#include "cli/web/page_file.h"
#include "cli/web/server.h"
#include "cli/web/sheet.h"
#include "meshreel/base/file.h"
#include "meshreel/meshreel.h"

namespace meshreel::cli {

namespace {

/// An animation in memory, and what the page is sent of it.
class HeldSheet : public ByteSource {
public:
    HeldSheet(Animation animation, Threads threads) : animation_(std::move(animation)), sheet_(animation_, threads) {}
    std::uint64_t size() const override { return sheet_.size(); }
    Result<Bytes> fetch(std::uint64_t offset, std::size_t count) override { return sheet_.fetch(offset, count); }
    const Animation& animation() const { return animation_; }

private:
    Animation animation_;
    Sheet sheet_;
};

class HeldBytes : public ByteSource {
public:
    explicit HeldBytes(Bytes bytes) : bytes_(std::move(bytes)) {}
    std::uint64_t size() const override { return bytes_.size(); }
    Result<Bytes> fetch(std::uint64_t offset, std::size_t count) override
    {
        return MemorySource(bytes_).fetch(offset, count);
    }

private:
    Bytes bytes_;
};

Resource held(const std::string& mime_type, std::shared_ptr<ByteSource> source)
{
    return {mime_type, [source] { return Result<std::shared_ptr<ByteSource>>(source); }};
}

/// A .reel file as it is at the time: one that was made anew is seen when the page is loaded again.
Resource reel_resource(const std::string& path)
{
    const auto open = [path]() -> Result<std::shared_ptr<ByteSource>> {
        MESHREEL_TRY(FileSource file, FileSource::open(path));
        return std::shared_ptr<ByteSource>(std::make_shared<FileSource>(std::move(file)));
    };
    return {"application/octet-stream", open};
}

std::string file_name(const std::string& path)
{
    return std::filesystem::path(path).filename().string();
}

class Play : public Verb {
public:
    void declare(CLI::App& app) override
    {
        app.add_option("FILE", paths_, "files or sequences such as walk.####.obj")->required();
        app.add_option("--against", against_, "the original: shown beside them, with the error as colour")
            ->type_name("ORIGINAL");
        app.add_option("--port", port_, "the port on 127.0.0.1; default: any that is free")
            ->check(CLI::Range(1, 65535))
            ->type_name("N");
        app.add_flag("--no-open", no_open_, "only say the address, and open no browser");
        app.add_option("--page", page_, "another page than the one that belongs to this command")->type_name("FILE");
        source_.declare(app);
        app.footer("It answers on 127.0.0.1 only, under an address that nobody can guess, until Ctrl-C.\n\nExamples:\n"
                   "  meshreel play walk.reel\n"
                   "  meshreel play coarse.reel fine.reel --against walk.glb\n"
                   "  meshreel play motion.pc2 --mesh mesh.obj --fps 25 --no-open\n");
    }

    Result<Report> run(Console& console) override
    {
        MESHREEL_TRY(const std::string page, load_page(page_));
        MESHREEL_CHECK(load_original(console));
        for (const std::string& path : paths_) MESHREEL_CHECK(add_item(path, console));
        manifest_["items"] = items_;
        const std::string manifest = manifest_.dump(-1, ' ', false, Json::error_handler_t::replace);
        resources_["manifest.json"] =
            held("application/json", std::make_shared<HeldBytes>(Bytes(manifest.begin(), manifest.end())));
        resources_[""] = held("text/html; charset=utf-8", std::make_shared<HeldBytes>(Bytes(page.begin(), page.end())));
        MESHREEL_TRY(Server server, Server::bind(std::move(resources_), port_));
        MESHREEL_CHECK(tell(server, console));
        if (!no_open_ && !open_in_browser(server.address()))
            console.warn("there is no xdg-open to start a browser; open the address above");
        MESHREEL_CHECK(server.run());
        return Report{};
    }

private:
    /// The address is known before the work is done, which ends by Ctrl-C.
    static Status tell(const Server& server, const Console& console)
    {
        const Json figures{{"schema", "meshreel.play/1"}, {"address", server.address()}, {"port", server.port()}};
        const std::string line = console.json ? figures.dump(2) : server.address();
        const bool told = std::printf("%s\n", line.c_str()) > 0 && std::fflush(stdout) == 0;
        if (!told) return Error{ErrorCode::io, "cannot write", {}, "standard output"};
        return Ok{};
    }

    Status load_original(Console& console)
    {
        if (against_.empty()) return Ok{};
        Source source = source_;
        source.path = against_;
        source.base = {};
        if (source.is_reel()) source.fps = 0.0;
        MESHREEL_TRY(Animation animation, load(source, console));
        original_ = std::make_shared<HeldSheet>(std::move(animation), source_.threads);
        resources_["original"] = held("application/octet-stream", original_);
        return Ok{};
    }

    Status add_item(const std::string& path, Console& console)
    {
        Source source = source_;
        source.path = path;
        if (source.is_reel() && original_) source.fps = 0.0; // --fps speaks of the original then
        const std::string url = fmt::format("item-{}", items_.size());
        const bool as_it_is = source.is_reel() && source.base.empty() && source.as_stored() && path != "-";
        Json item{{"name", file_name(path)}, {"kind", as_it_is ? "reel" : "sheet"}, {"url", url}};
        if (as_it_is) {
            MESHREEL_CHECK(describe_reel(path, item));
            resources_[url] = reel_resource(path);
        } else {
            MESHREEL_TRY(Animation animation, load(source, console));
            std::error_code none;
            const auto size = std::filesystem::file_size(path, none);
            item["bytes"] = source.is_reel() && !none ? size : raw_bytes(animation);
            item["raw"] = !source.is_reel();
            resources_[url] =
                held("application/octet-stream", std::make_shared<HeldSheet>(std::move(animation), source_.threads));
        }
        items_.push_back(std::move(item));
        return Ok{};
    }

    /// A file that is wrong is described by what the page will say of it.
    Status describe_reel(const std::string& path, Json& item)
    {
        MESHREEL_TRY(const Bytes bytes, read_file(path, source_.limits));
        item["bytes"] = bytes.size();
        const Result<Info> about = info(bytes, source_.limits);
        if (about.ok()) item["levels"] = about->level_bytes.size();
        if (!original_) return Ok{};
        item["original"] = Json{{"name", file_name(against_)}, {"kind", "sheet"}, {"url", "original"}};
        if (about.ok() && about->order == Order::free) item["original"]["url"] = free_original(bytes);
        return Ok{};
    }

    /// The original numbered as a file is that dropped its order, if that is how the file is numbered.
    std::string free_original(const Bytes& reel)
    {
        const Result<Animation> first = decode(reel, {.frames = {.first = 0, .last = 0}, .limits = source_.limits});
        Animation renumbered = in_free_order(original_->animation(), source_.threads);
        if (!first.ok() || first->triangles != renumbered.triangles) return "original";
        resources_["original-free"] =
            held("application/octet-stream", std::make_shared<HeldSheet>(std::move(renumbered), source_.threads));
        return "original-free";
    }

    std::vector<std::string> paths_;
    std::string against_, page_;
    int port_ = 0;
    bool no_open_ = false;
    Source source_;
    std::shared_ptr<HeldSheet> original_;
    Server::Resources resources_;
    Json items_ = Json::array();
    Json manifest_{{"schema", "meshreel.play/1"}};
};

} // namespace

std::unique_ptr<Verb> make_play()
{
    return std::make_unique<Play>();
}

} // namespace meshreel::cli
