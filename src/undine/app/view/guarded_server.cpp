#include "undine/app/view/guarded_server.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace undine {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::size_t connections = 256;        ///< at a time; each has a thread, nearly all of them asleep
constexpr int requests_per_connection = 100;    ///< a browser then connects anew
constexpr std::size_t request_bytes = 16'384;   ///< of one request with its headers
constexpr Clock::duration request_time = 5s;    ///< from its first byte to its last
constexpr Clock::duration idle_time = 5s;       ///< between two requests
constexpr Clock::duration answering_time = 5s;  ///< for a client to take some more of its answer

/// Waits until the socket can be read or written; false where it cannot be in time.
bool ready(socket_t socket, short events, Clock::time_point deadline) {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd wait{.fd = socket, .events = events, .revents = 0};
    const int found = ::poll(&wait, 1, static_cast<int>(std::max<std::int64_t>(0, left)));
    if (found >= 0 || errno != EINTR) return found > 0;
  }
}

/// One client's bytes, within the bounds.
class Connection final : public httplib::Stream {
 public:
  explicit Connection(socket_t socket) : socket_(socket) {}

  /// Whether a request begins in time; its bounds are counted from here.
  bool next_request() {
    if (begin_ == end_ && !ready(socket_, POLLIN, Clock::now() + idle_time)) return false;
    deadline_ = Clock::now() + request_time;
    taken_ = 0;
    return true;
  }

  bool is_readable() const override { return begin_ != end_ || ready(socket_, POLLIN, deadline_); }
  bool is_writable() const override { return ready(socket_, POLLOUT, Clock::now() + answering_time); }

  ssize_t read(char* to, std::size_t size) override {
    if (taken_ >= request_bytes) return -1;
    if (begin_ == end_) {
      if (!is_readable()) return -1;
      const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
      if (got <= 0) return got;
      begin_ = 0;
      end_ = static_cast<std::size_t>(got);
    }
    const std::size_t count = std::min({size, end_ - begin_, request_bytes - taken_});
    std::memcpy(to, buffer_.data() + begin_, count);
    begin_ += count;
    taken_ += count;
    return static_cast<ssize_t>(count);
  }

  ssize_t write(const char* from, std::size_t size) override {
    return is_writable() ? ::send(socket_, from, size, MSG_NOSIGNAL) : -1;
  }

  void get_remote_ip_and_port(std::string&, int&) const override {}  // nobody asks
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return socket_; }

 private:
  socket_t socket_;
  std::array<char, 4096> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of what was received and not yet read
  std::size_t taken_ = 0;            ///< of this request
  Clock::time_point deadline_ = {};  ///< of this request
};

bool has_body(const httplib::Request& request) {
  return request.has_header("Transfer-Encoding") ||
         (request.has_header("Content-Length") && request.get_header_value("Content-Length") != "0");
}

}  // namespace

GuardedServer::GuardedServer() {
  new_task_queue = [] { return new httplib::ThreadPool(connections); };
}

bool GuardedServer::process_and_close_socket(socket_t socket) {
  Connection connection(socket);
  bool good = true, closed = false;
  for (int left = requests_per_connection; good && !closed && left > 0 && connection.next_request(); --left) {
    bool body = false;
    good = process_request(connection, left == 1, closed, [&](httplib::Request& request) {
      request.ranges.clear();  // parts of an answer, of which a client may ask for thousands
      // Numbers are packed already; the library would pack them again, a minute long for 6 MB in brotli.
      request.headers.erase("Accept-Encoding");
      body = has_body(request);
    });
    closed = closed || body;  // no body is read, and what is left of it is no request
  }
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return good;
}

}  // namespace undine
