/// A small web server for one page on this machine: loopback alone, behind a key, of a fixed list of resources.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "meshreel/base/byte_source.h"
#include "meshreel/base/result.h"

namespace meshreel::cli {

/// Something that the page may ask for. It is opened anew for each request, so that a file made again is seen.
struct Resource {
    std::string mime_type;
    std::function<Result<std::shared_ptr<ByteSource>>()> open;
};

class Server {
public:
    /// By name, as it stands behind the key in an address; "" is the page itself.
    using Resources = std::map<std::string, Resource>;

    /// Takes the port, on 127.0.0.1. port 0: any. @fails io: somebody else has it.
    static Result<Server> bind(Resources resources, int port);
    Server(Server&&) noexcept;
    ~Server();

    /// http://127.0.0.1:PORT/KEY/ with a key of 128 random bits: other users of this machine do not know it.
    std::string address() const;
    int port() const;
    /// Answers until the process ends. @fails io.
    Status run();

private:
    struct Inside;
    explicit Server(std::unique_ptr<Inside> inside);
    std::unique_ptr<Inside> inside_;
};

/// Has the desktop open an address in its browser. False: there is none.
bool open_in_browser(const std::string& address);

} // namespace meshreel::cli
