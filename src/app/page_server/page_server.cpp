#include "app/page_server/page_server.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>

namespace holdfast::internal {

namespace {

constexpr const char* kLoopback = "127.0.0.1";
/// Bytes of the file in memory at once, for each answer.
constexpr std::size_t kPiece = 1U << 18U;

/// Hands the bytes of a file from `offset` on to an answer, piece by piece.
bool send_piece(int file, std::size_t offset, std::size_t length, httplib::DataSink& sink) {
  std::array<char, kPiece> piece;
  const ssize_t count = pread(file, piece.data(), std::min(length, piece.size()), off_t(offset));
  // A file that has become shorter ends the answer.
  return count > 0 && sink.write(piece.data(), std::size_t(count));
}

/// Only requests for this address are answered: a page elsewhere that gives its own name this address gets nothing.
bool asks_for(const httplib::Request& request, int port) {
  const std::string host = request.get_header_value("Host");
  return host == fmt::format("{}:{}", kLoopback, port) || host == fmt::format("localhost:{}", port);
}

std::optional<Error> serve(const ServedPage& served, int file,
                           const std::function<void(const std::string&)>& listening) {
  struct stat state = {};
  if (fstat(file, &state) != 0)
    return Error{.file = served.results_path, .what = std::generic_category().message(errno)};
  const auto size = std::size_t(state.st_size);

  httplib::Server server;
  server.set_tcp_nodelay(true);
  // The library's own options let another process listen to the same port.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_default_headers({{"Cache-Control", "no-store"},
                              {"Referrer-Policy", "no-referrer"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Cross-Origin-Resource-Policy", "same-origin"}});
  const int port = served.port == 0                              ? server.bind_to_any_port(kLoopback)
                   : server.bind_to_port(kLoopback, served.port) ? served.port
                                                                 : -1;
  if (port < 0) return Error{.what = "the port is not free", .value = std::to_string(served.port)};
  server.set_pre_routing_handler([port](const httplib::Request& request, httplib::Response& response) {
    if (asks_for(request, port)) return httplib::Server::HandlerResponse::Unhandled;
    response.status = 403;
    return httplib::Server::HandlerResponse::Handled;
  });
  const std::string home = "/" + served.token + "/";
  server.Get(home, [&served](const httplib::Request&, httplib::Response& response) {
    // Given at once, the library would pack it with Brotli's strongest level, for 13 seconds.
    response.set_content_provider(served.page.size(), "text/html; charset=utf-8",
                                  [&served](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                    return sink.write(served.page.data() + offset, length);
                                  });
  });
  server.Get(home + kResultsAddress, [file, size](const httplib::Request&, httplib::Response& response) {
    response.set_header("Accept-Ranges", "bytes");
    response.set_content_provider(size, "application/octet-stream",
                                  [file](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                    return send_piece(file, offset, length, sink);
                                  });
  });
  listening(fmt::format("http://{}:{}{}", kLoopback, port, home));
  server.listen_after_bind();
  return std::nullopt;
}

}  // namespace

}  // namespace holdfast::internal

extern "C" __attribute__((visibility("default"))) void holdfast_serve_page(
    const holdfast::internal::ServedPage& served, const std::function<void(const std::string&)>& listening,
    std::optional<holdfast::internal::Error>& error) {
  using namespace holdfast::internal;
  const int file = open(served.results_path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    error = Error{.file = served.results_path, .what = std::generic_category().message(errno)};
    return;
  }
  error = serve(served, file, listening);
  close(file);
}
