/// Answers GET and HEAD, under the right host name and key; everything else is refused.
// SPDX-License-Identifier: MIT
#include "cli/web/server.h"

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <random>
#include <spawn.h>
#include <sys/socket.h>

#include <fmt/format.h>
#include <httplib.h>

extern char** environ;

namespace meshreel::cli {

namespace {

constexpr const char* loopback = "127.0.0.1";

std::string random_key()
{
    std::random_device random;
    std::string key;
    for (int word = 0; word < 4; ++word) key += fmt::format("{:08x}", random());
    return key;
}

/// What the page may do is said here, and not by whoever embeds it: nobody may.
void add_headers(httplib::Response& response)
{
    response.set_header("Cache-Control", "no-store");
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Referrer-Policy", "no-referrer");
    response.set_header("Cross-Origin-Resource-Policy", "same-origin");
    response.set_header("Content-Security-Policy", "frame-ancestors 'none'");
}

void refuse(httplib::Response& response, int status, const std::string& sentence)
{
    response.status = status;
    response.set_content(sentence + "\n", "text/plain; charset=utf-8");
}

void send(const std::string& mime_type, std::shared_ptr<ByteSource> source, httplib::Response& response)
{
    static constexpr std::size_t part = 1 << 20;
    const auto size = static_cast<std::size_t>(source->size());
    if (size == 0) return response.set_content("", mime_type.c_str());
    response.set_content_provider(
        size, mime_type.c_str(), [source](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
            const Result<Bytes> bytes = source->fetch(offset, std::min(length, part));
            return bytes.ok() && sink.write(reinterpret_cast<const char*>(bytes->data()), bytes->size());
        });
}

} // namespace

struct Server::Inside {
    Resources resources;
    std::string key = random_key();
    int port = 0;
    httplib::Server http;

    /// Whether a request is for us: a page elsewhere whose name leads to this machine has another host name.
    bool may_pass(const httplib::Request& request, httplib::Response& response) const
    {
        const std::string host = request.get_header_value("Host");
        if (host != fmt::format("{}:{}", loopback, port) && host != fmt::format("localhost:{}", port))
            return refuse(response, 403, "this is no address of this page"), false;
        if (request.method != "GET" && request.method != "HEAD")
            return refuse(response, 405, "there is nothing to be written here"), false;
        return true;
    }

    void answer(const httplib::Request& request, httplib::Response& response) const
    {
        const std::string prefix = "/" + key + "/";
        const bool known = request.path.compare(0, prefix.size(), prefix) == 0;
        const auto found = known ? resources.find(request.path.substr(prefix.size())) : resources.end();
        if (found == resources.end())
            return refuse(response, 404, "there is nothing here; the whole address stands in the terminal");
        Result<std::shared_ptr<ByteSource>> source = found->second.open();
        if (!source.ok()) return refuse(response, 500, source.error().sentence());
        send(found->second.mime_type, std::move(*source), response);
    }
};

Server::Server(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
Server::Server(Server&&) noexcept = default;
Server::~Server() = default;

Result<Server> Server::bind(Resources resources, int port)
{
    auto inside = std::make_unique<Inside>();
    inside->resources = std::move(resources);
    httplib::Server& http = inside->http;
    http.set_socket_options([](int socket) { // the library's own would share the port with others
        const int yes = 1;
        ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    http.set_payload_max_length(0);
    http.set_keep_alive_max_count(1); // a connection that waits holds a thread
    http.new_task_queue = [] { return new httplib::ThreadPool(16); };
    inside->port = port == 0 ? http.bind_to_any_port(loopback) : http.bind_to_port(loopback, port) ? port : -1;
    if (inside->port <= 0)
        return Error{
            ErrorCode::io, port == 0 ? "no port is free" : fmt::format("port {} is taken", port), {}, loopback};
    const Inside* const answering = inside.get(); // stays where it is
    http.set_pre_routing_handler([answering](const httplib::Request& request, httplib::Response& response) {
        add_headers(response);
        return answering->may_pass(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                                      : httplib::Server::HandlerResponse::Handled;
    });
    http.Get(".*", [answering](const httplib::Request& request, httplib::Response& response) {
        answering->answer(request, response);
    });
    return Server(std::move(inside));
}

std::string Server::address() const
{
    return fmt::format("http://{}:{}/{}/", loopback, inside_->port, inside_->key);
}

int Server::port() const
{
    return inside_->port;
}

Status Server::run()
{
    if (inside_->http.listen_after_bind()) return Ok{};
    return Error{ErrorCode::io, "the server has stopped", {}, address()};
}

bool open_in_browser(const std::string& address)
{
    posix_spawn_file_actions_t streams;
    posix_spawnattr_t attributes;
    sigset_t none, broken_pipe;
    ::sigemptyset(&none);
    ::sigemptyset(&broken_pipe);
    ::sigaddset(&broken_pipe, SIGPIPE);
    ::posix_spawn_file_actions_init(&streams);
    for (const int stream : {0, 1, 2}) ::posix_spawn_file_actions_addopen(&streams, stream, "/dev/null", O_RDWR, 0);
    ::posix_spawnattr_init(&attributes); // it shall not inherit how this command takes signals (interrupt.h)
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &broken_pipe);
    std::string name = "xdg-open", copy = address;
    char* arguments[] = {name.data(), copy.data(), nullptr};
    pid_t child = 0;
    const bool started = ::posix_spawnp(&child, name.c_str(), &streams, &attributes, arguments, environ) == 0;
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&streams);
    return started;
}

} // namespace meshreel::cli
