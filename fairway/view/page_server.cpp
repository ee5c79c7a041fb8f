#include "fairway/view/page_server.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <httplib.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/run/products.hpp"
#include "fairway/view/engine.hpp"
#include "fairway/view/limited_server.hpp"
#include "fairway/view/question.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using httplib::Request;
using httplib::Response;
using nlohmann::json;

constexpr const char* loopback = "127.0.0.1";

/// The bytes of a regular file in the folder; none for anything else, including links.
std::optional<std::string> product_bytes(const fs::path& folder, const std::string& name) {
  const int file = ::open((folder / name).c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return std::nullopt;
  struct stat status {};
  std::optional<std::string> bytes;
  if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode)) {
    bytes.emplace(static_cast<std::size_t>(status.st_size), '\0');
    std::size_t done = 0;
    while (done < bytes->size()) {
      const ssize_t n = ::read(file, bytes->data() + done, bytes->size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      done += static_cast<std::size_t>(n);
    }
    if (done < bytes->size()) bytes.reset();
  }
  ::close(file);
  return bytes;
}

const char* type_of(const std::string& name) {
  static constexpr std::array<std::pair<const char*, const char*>, 6> types{
      {{".html", "text/html; charset=utf-8"},
       {".json", "application/json"},
       {".geojson", "application/geo+json"},
       {".csv", "text/csv; charset=utf-8"},
       {".svg", "image/svg+xml"},
       {".png", "image/png"}}};
  for (const auto& [ending, type] : types) {
    if (name.ends_with(ending)) return type;
  }
  return "application/octet-stream";
}

/// Uncompressed: the library would use Brotli at its slowest, which takes longer than sending the
/// bytes over a loopback.
void send(Response& response, std::string bytes, const char* type) {
  const auto kept = std::make_shared<const std::string>(std::move(bytes));
  response.set_content_provider(
      kept->size(), type, [kept](std::size_t at, std::size_t length, httplib::DataSink& sink) {
        return sink.write(kept->data() + at, length);
      });
}

void tell(Response& response, int status, const json& answer) {
  response.status = status;
  send(response, answer.dump(-1, ' ', true, json::error_handler_t::replace) + "\n",
       "application/json");
}

void refuse(Response& response, int status, const std::string& reason) {
  tell(response, status, {{"error", reason}});
}

const char* reason_of(int status) {
  switch (status) {
    case 400:
      return "the request is malformed";
    case 404:
      return "no such name";
    case 413:
      return "a request must not have a body";
    case 416:
      return "products are sent whole; ranges are not supported";
    case 414:
      return "the address is too long";
    default:
      return "the request could not be answered";
  }
}

}  // namespace

struct PageServer::Parts {
  fs::path folder;
  const LiveEngine& engine;
  LimitedServer http;
  int port = 0;
  std::atomic<bool> stopped{false};

  Parts(fs::path place, const LiveEngine& answers, const PageLimits& limits)
      : folder(std::move(place)), engine(answers), http(limits) {}

  /// True: refused, because nobody may ask this.
  bool refuses(const Request& request, Response& response) const {
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Cross-Origin-Resource-Policy", "same-origin");
    response.set_header("Referrer-Policy", "no-referrer");
    response.set_header("Cache-Control", "no-store");
    response.set_header("Accept-Ranges", "none");
    if (request.get_header_value_count("Host") != 1 ||
        !is_local_host(request.get_header_value("Host"), port)) {
      refuse(response, 403,
             fmt::format("the Host header must be {0}:{1} or localhost:{1}", loopback, port));
      return true;
    }
    const std::string from = request.get_header_value("Sec-Fetch-Site");
    if (request.path.starts_with("/api/") && !from.empty() && from != "same-origin" &&
        from != "none") {
      refuse(response, 403, "requests from other pages are refused");
      return true;
    }
    if (request.method != "GET" && request.method != "HEAD") {
      response.set_header("Allow", "GET, HEAD");
      refuse(response, 405, "only GET and HEAD are supported");
      return true;
    }
    return false;
  }

  void answer(const Request& request, Response& response) const {
    try {
      if (request.path.starts_with("/api/")) {
        tell(response, 200, question(request));
        return;
      }
      require_parameters(request.params, {});
      const std::string name = request.path == "/" ? product::report_page : request.path.substr(1);
      static const std::vector<std::string> names = product_names();
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        refuse(response, 404, reason_of(404));
        return;
      }
      auto bytes = product_bytes(folder, name);
      if (!bytes) {
        refuse(response, 404, fmt::format("{} is not in this folder", name));
        return;
      }
      response.status = 200;
      send(response, std::move(*bytes), type_of(name));
    } catch (const BadQuestion& wrong) {
      refuse(response, 400, wrong.what());
    } catch (const NotNow& busy) {
      refuse(response, 503, busy.what());
    } catch (const std::out_of_range&) {
      refuse(response, 404, reason_of(404));
    }
  }

  /// Throws BadQuestion, or out_of_range for an unknown question.
  json question(const Request& request) const {
    const Parameters& given = request.params;
    if (request.path == "/api/info") {
      require_parameters(given, {});
      return engine.info();
    }
    if (request.path == "/api/state") {
      if (given.contains("goal_x") || given.contains("goal_y")) {
        require_parameters(given, {"x", "y", "h", "goal_x", "goal_y"});
        return engine.state(state_parameters(given, "x", "y", "h"),
                            place_parameters(given, "goal_x", "goal_y"));
      }
      require_parameters(given, {"x", "y", "h"});
      return engine.state(state_parameters(given, "x", "y", "h"));
    }
    if (request.path == "/api/replan" || request.path == "/api/proof") {
      require_parameters(given, {"goal_x", "goal_y"});
      const Vec2 goal_m = place_parameters(given, "goal_x", "goal_y");
      return request.path == "/api/replan" ? engine.replan(goal_m) : engine.proof(goal_m);
    }
    if (request.path == "/api/steer") {
      require_parameters(given, {"x", "y", "h", "to_x", "to_y", "to_h"});
      return engine.steer(state_parameters(given, engine.grid(), "x", "y", "h"),
                          state_parameters(given, engine.grid(), "to_x", "to_y", "to_h"));
    }
    throw std::out_of_range("unknown question");
  }

  void set_up() {
    // Without SO_REUSEPORT, which the library would set: a second server must not share a port.
    http.set_socket_options([](auto socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    http.set_payload_max_length(0);
    http.set_tcp_nodelay(true);
    http.set_pre_routing_handler([this](const Request& request, Response& response) {
      if (!refuses(request, response)) answer(request, response);
      return httplib::Server::HandlerResponse::Handled;
    });
    http.set_error_handler([](const Request&, Response& response) {
      if (!response.has_header("Content-Type"))
        refuse(response, response.status, reason_of(response.status));
    });
    http.set_exception_handler([](const Request&, Response& response, const std::exception_ptr&) {
      refuse(response, 500, "internal error (please report it)");
    });
  }
};

PageServer::PageServer(fs::path folder, const LiveEngine& engine, int port, PageLimits limits)
    : parts_(std::make_unique<Parts>(std::move(folder), engine, limits)) {
  parts_->set_up();
  if (port == 0) {
    parts_->port = parts_->http.bind_to_any_port(loopback);
  } else {
    parts_->port = parts_->http.bind_to_port(loopback, port) ? port : -1;
  }
  if (parts_->port <= 0) {
    throw InputError("--port", fmt::format("{} is in use or needs privileges; use 0 to pick a "
                                           "free port",
                                           port));
  }
  parts_->http.have_many_wait();
}

PageServer::~PageServer() { stop(); }

int PageServer::port() const { return parts_->port; }

std::string PageServer::address() const { return fmt::format("http://{}:{}/", loopback, port()); }

void PageServer::serve() {
  if (!parts_->stopped) parts_->http.listen_after_bind();
}

void PageServer::stop() {
  parts_->stopped = true;
  parts_->http.let_go();
  parts_->http.stop();
}

}  // namespace fairway
