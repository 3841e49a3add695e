#include "undine/app/view/view.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string_view>

#include <fmt/format.h>
#include <sys/random.h>

#include "undine/app/report/report.hpp"
#include "undine/app/run/control.hpp"
#include "undine/app/view/guarded_server.hpp"
#include "undine/app/view/view_data.hpp"
#include "undine/core/error.hpp"

namespace undine {
namespace {

constexpr std::size_t usual_most = 200'000;  ///< particles of a frame where the page does not say
constexpr std::string_view place_of_data = "<!--UNDINE-DATA-->";

/// 128 random bits as 32 hexadecimal digits.
std::string random_token() {
  std::array<unsigned char, 16> bytes;
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Error({.what = "cannot choose a token", .why = "the system gives no random numbers"});
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

/// Takes the same time wherever the first difference is.
bool same(std::string_view a, std::string_view b) {
  unsigned char difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    difference = static_cast<unsigned char>(difference | (a[k] ^ b[k]));
  return difference == 0;
}

std::string page_for(bool follow) {
  const std::string_view page = report_page();
  const std::size_t at = page.rfind(place_of_data);
  return fmt::format("{}<script type=\"application/json\" id=\"undine-live\">{{\"follow\":{}}}</script>{}",
                     page.substr(0, at), follow, page.substr(at + place_of_data.size()));
}

/// A whole number from the query; `otherwise` where there is none.
std::size_t whole(const httplib::Request& request, const char* name, std::size_t otherwise) {
  if (!request.has_param(name)) return otherwise;
  const std::string text = request.get_param_value(name);
  std::size_t value = 0;
  const auto [end, reason] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (reason != std::errc() || end != text.data() + text.size())
    throw InputError({.what = fmt::format("'{}' is not a whole number", name)});
  return value;
}

/// Answers requests. What does not begin with the token learns nothing, and no part of a path becomes a file's name.
class Answers {
 public:
  Answers(const ViewOptions& options, std::string token)
      : data_(options.folder), page_(page_for(options.follow)), token_(std::move(token)) {}

  /// Names under which a browser may ask; empty: any, and then nobody may control the run. Guards against pages that
  /// make their name point to this machine.
  void set_hosts(std::vector<std::string> hosts) { hosts_ = std::move(hosts); }
  const std::string& token() const { return token_; }

  void operator()(const httplib::Request& request, httplib::Response& response) const {
    response.set_header("Cache-Control", "no-store");
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("X-Frame-Options", "DENY");
    response.set_header("Referrer-Policy", "no-referrer");
    try {
      answer(request, response);
    } catch (const InputError& error) {
      refuse(response, 400, error.parts().what);
    } catch (const std::exception&) {
      refuse(response, 500, "the run's files cannot be read just now");
    }
  }

 private:
  static void refuse(httplib::Response& response, int status, const std::string& why) {
    response.status = status;
    response.set_content(why + "\n", "text/plain");
  }

  void answer(const httplib::Request& request, httplib::Response& response) const {
    const bool host_fits = hosts_.empty() || std::ranges::count(hosts_, request.get_header_value("Host")) > 0;
    const std::string_view path = request.path;
    const bool token_fits = path.size() > token_.size() + 1 && path[0] == '/' &&
                            same(path.substr(1, token_.size()), token_) && path[token_.size() + 1] == '/';
    if (!host_fits || !token_fits)
      return refuse(response, 403, "this address needs the token that `undine view` printed");
    const std::string_view rest = path.substr(token_.size() + 2);
    if (rest == "control") return control(request, response);
    if (request.method != "GET" && request.method != "HEAD") return refuse(response, 405, "only GET is answered");
    if (rest.empty()) return response.set_content(page_, "text/html; charset=utf-8");
    if (rest == "data.json") return response.set_content(data_.all(), "application/json");
    if (rest == "state.json") return response.set_content(data_.state(local()), "application/json");
    if (rest == "frame.json")
      return response.set_content(data_.frame(whole(request, "number", 0), whole(request, "most", usual_most)),
                                  "application/json");
    refuse(response, 404, "there is no such page");
  }

  bool local() const { return !hosts_.empty(); }

  /// Whether the request comes from a page of ours, or from no page at all.
  static bool from_here(const httplib::Request& request) {
    const std::string site = request.get_header_value("Sec-Fetch-Site"), origin = request.get_header_value("Origin");
    return (site.empty() || site == "same-origin") &&
           (origin.empty() || origin == "http://" + request.get_header_value("Host"));
  }

  /// POST control?wish=pause|run|stop
  void control(const httplib::Request& request, httplib::Response& response) const {
    if (request.method != "POST") return refuse(response, 405, "only POST changes a run");
    if (!from_here(request)) return refuse(response, 403, "another site's page asks for this");
    if (!local()) return refuse(response, 403, "runs are controlled from their own machine only: leave out --host");
    const std::string wish = request.get_param_value("wish");
    if (!is_run_wish(wish)) return refuse(response, 400, "'wish' is run, pause or stop");
    if (!data_.send(wish)) return refuse(response, 409, "no run that was started with --control goes on here");
    response.set_content(wish + "\n", "text/plain");
  }

  ViewData data_;
  std::string page_, token_;
  std::vector<std::string> hosts_;
};

}  // namespace

int view_command(const ViewOptions& options) {
  Answers answers(options, random_token());
  GuardedServer server;
  server.set_tcp_nodelay(true);
  // Only after a server that ended: two at one port would share its visitors.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_pre_routing_handler([&](const httplib::Request& request, httplib::Response& response) {
    answers(request, response);
    return httplib::Server::HandlerResponse::Handled;
  });
  const int port = options.port != 0 ? (server.bind_to_port(options.host, options.port) ? options.port : -1)
                                     : server.bind_to_any_port(options.host);
  if (port < 0)
    throw InputError({.what = fmt::format("cannot listen on {}:{}", options.host, options.port),
                      .fix = "choose another --port, or leave it out"});
  if (options.host == "127.0.0.1")
    answers.set_hosts({fmt::format("127.0.0.1:{}", port), fmt::format("localhost:{}", port)});
  else
    fmt::print("others can reach this page where they know its address and can reach {}\n", options.host);
  fmt::print("open http://{}:{}/{}/ in a browser; Ctrl-C ends this\n", options.host, port, answers.token());
  std::fflush(stdout);
  if (!server.listen_after_bind()) throw Error({.what = "the server stopped", .why = "it can no longer listen"});
  return 0;
}

}  // namespace undine
