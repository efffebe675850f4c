#include "app/page_server/page_server.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <strings.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

namespace holdfast::internal {

namespace {

constexpr const char* kLoopback = "127.0.0.1";
/// A browser opens six; whoever holds more is in nobody's way, since one thread waits for all of them.
constexpr unsigned kMostConnections = 512;
constexpr unsigned kIdleSeconds = 10;  // until a connection on which nothing happens is closed
/// Bytes of a connection, which are enough for some 8 KB of headers.
constexpr std::size_t kConnectionBytes = std::size_t{16} << 10U;

/// What all requests are answered from.
struct Served {
  const ServedPage* page = nullptr;
  int file = -1;
  std::uint64_t size = 0;
  std::string home;  ///< path of the page
  std::string host;  ///< "127.0.0.1:PORT"
  std::string local_host;
};

using Response = std::unique_ptr<MHD_Response, void (*)(MHD_Response*)>;

/// Bytes [begin, end) of a file.
struct ByteRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

/// Reads the digits at the beginning of the text, and takes them from it.
std::optional<std::uint64_t> take_number(std::string_view& text) {
  std::uint64_t number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  return number;
}

enum class Asked { whole, range, beyond };

/// What a header `Range` asks for (RFC 9110, 14.1.2). One that is not understood, or has several ranges, asks for the
/// whole file.
Asked asked_range(std::string_view header, std::uint64_t size, ByteRange& range) {
  constexpr std::string_view kUnit = "bytes=";
  if (!header.starts_with(kUnit)) return Asked::whole;
  header.remove_prefix(kUnit.size());
  const std::optional<std::uint64_t> first = take_number(header);
  if (!header.starts_with('-')) return Asked::whole;
  header.remove_prefix(1);
  const std::optional<std::uint64_t> last = take_number(header);
  if (!header.empty() || (!first && !last) || (first && last && *last < *first)) return Asked::whole;
  if (first) {
    range = {*first, last && *last < size ? *last + 1 : size};
  } else {
    range = {size - std::min(size, *last), size};
  }
  return range.begin < range.end ? Asked::range : Asked::beyond;
}

std::string_view header_of(MHD_Connection* connection, const char* name) {
  const char* value = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, name);
  return value != nullptr ? value : "";
}

/// Only requests for this address are answered: a page elsewhere that gives its own name this address gets nothing.
bool asks_for(MHD_Connection* connection, const Served& served) {
  struct Hosts {
    int count = 0;
    std::string_view last;
  } hosts;
  const auto count = [](void* to, MHD_ValueKind, const char* name, const char* value) -> MHD_Result {
    if (std::string_view(name).size() != 4 || strcasecmp(name, "Host") != 0) return MHD_YES;
    ++static_cast<Hosts*>(to)->count;
    static_cast<Hosts*>(to)->last = value != nullptr ? value : "";
    return MHD_YES;
  };
  MHD_get_connection_values(connection, MHD_HEADER_KIND, count, &hosts);
  return hosts.count == 1 && (hosts.last == served.host || hosts.last == served.local_host);
}

bool has_body(MHD_Connection* connection) {
  const std::string_view length = header_of(connection, "Content-Length");
  return !header_of(connection, "Transfer-Encoding").empty() || (!length.empty() && length != "0");
}

Response empty_response() {
  return {MHD_create_response_from_buffer(0, nullptr, MHD_RESPMEM_PERSISTENT), MHD_destroy_response};
}

MHD_Result answer(MHD_Connection* connection, unsigned status, const Response& response) {
  for (const auto& [name, value] :
       {std::pair("Cache-Control", "no-store"), std::pair("Referrer-Policy", "no-referrer"),
        std::pair("X-Content-Type-Options", "nosniff"), std::pair("Cross-Origin-Resource-Policy", "same-origin")})
    MHD_add_response_header(response.get(), name, value);
  return MHD_queue_response(connection, status, response.get());
}

MHD_Result answer_page(MHD_Connection* connection, const Served& served) {
  const std::string& page = served.page->page;
  const Response response(
      MHD_create_response_from_buffer(page.size(), const_cast<char*>(page.data()), MHD_RESPMEM_PERSISTENT),
      MHD_destroy_response);
  MHD_add_response_header(response.get(), "Content-Type", "text/html; charset=utf-8");
  return answer(connection, MHD_HTTP_OK, response);
}

MHD_Result answer_results(MHD_Connection* connection, const Served& served) {
  ByteRange range{0, served.size};
  const Asked asked = asked_range(header_of(connection, "Range"), served.size, range);
  if (asked == Asked::beyond) {
    const Response response = empty_response();
    MHD_add_response_header(response.get(), "Content-Range", fmt::format("bytes */{}", served.size).c_str());
    return answer(connection, MHD_HTTP_RANGE_NOT_SATISFIABLE, response);
  }
  // The response closes its file.
  const int file = fcntl(served.file, F_DUPFD_CLOEXEC, 0);
  const Response response(MHD_create_response_from_fd_at_offset64(range.end - range.begin, file, range.begin),
                          MHD_destroy_response);
  if (response == nullptr) {
    close(file);
    return MHD_NO;
  }
  MHD_add_response_header(response.get(), "Content-Type", "application/octet-stream");
  MHD_add_response_header(response.get(), "Accept-Ranges", "bytes");
  if (asked == Asked::whole) return answer(connection, MHD_HTTP_OK, response);
  MHD_add_response_header(response.get(), "Content-Range",
                          fmt::format("bytes {}-{}/{}", range.begin, range.end - 1, served.size).c_str());
  return answer(connection, MHD_HTTP_PARTIAL_CONTENT, response);
}

/// Called when the headers of a request are there, and once more when all of it is, unless it is answered before.
MHD_Result take_request(void* context, MHD_Connection* connection, const char* url, const char* method,
                        const char* /*version*/, const char* /*body*/, std::size_t* /*body_size*/, void** seen) {
  const auto& served = *static_cast<const Served*>(context);
  if (!asks_for(connection, served)) return answer(connection, MHD_HTTP_FORBIDDEN, empty_response());
  const std::string_view verb = method;
  if (verb != "GET" && verb != "HEAD") return answer(connection, MHD_HTTP_METHOD_NOT_ALLOWED, empty_response());
  // An answer before the body is there ends the connection: nothing of the body is read.
  if (has_body(connection)) return answer(connection, MHD_HTTP_CONTENT_TOO_LARGE, empty_response());
  if (*seen == nullptr) {
    *seen = context;
    return MHD_YES;
  }
  if (url == served.home) return answer_page(connection, served);
  if (url == served.home + kResultsAddress) return answer_results(connection, served);
  return answer(connection, MHD_HTTP_NOT_FOUND, empty_response());
}

/// A socket that listens to this machine alone, and its port; -1 where the port is not free.
struct Listening {
  int socket = -1;
  std::uint16_t port = 0;
};

Listening listen_to(int port) {
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, kLoopback, &address.sin_addr);
  auto* name = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int yes = 1;  // also soon after another server on the same port
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (bind(socket, name, size) != 0 || listen(socket, SOMAXCONN) != 0 || getsockname(socket, name, &size) != 0) {
    close(socket);
    return {};
  }
  return {socket, ntohs(address.sin_port)};
}

std::optional<Error> serve(const ServedPage& page, int file, const std::function<void(const std::string&)>& listening) {
  struct stat state = {};
  if (fstat(file, &state) != 0) return Error{.file = page.results_path, .what = std::generic_category().message(errno)};
  const auto [socket, port] = listen_to(page.port);
  if (socket < 0) return Error{.what = "the port is not free", .value = std::to_string(page.port)};
  Served served{.page = &page,
                .file = file,
                .size = static_cast<std::uint64_t>(state.st_size),
                .home = "/" + page.token + "/",
                .host = fmt::format("{}:{}", kLoopback, port),
                .local_host = fmt::format("localhost:{}", port)};
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the library's interface
  MHD_Daemon* daemon = MHD_start_daemon(MHD_USE_EPOLL_INTERNAL_THREAD, 0, nullptr, nullptr, take_request, &served,
                                        MHD_OPTION_LISTEN_SOCKET, socket, MHD_OPTION_CONNECTION_LIMIT, kMostConnections,
                                        MHD_OPTION_CONNECTION_TIMEOUT, kIdleSeconds, MHD_OPTION_CONNECTION_MEMORY_LIMIT,
                                        kConnectionBytes, MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_END);
  if (daemon == nullptr) return Error{.what = "the page cannot be served", .value = std::strerror(errno)};
  listening(fmt::format("http://{}{}", served.host, served.home));
  while (true) pause();
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
