// The library's server with limits on its clients. Private to page_server.cpp.
#pragma once

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
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <httplib.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace fairway {

using httplib::Request;
using httplib::Response;

/// A thread for each connection, created when needed and kept.
class Connections final : public httplib::TaskQueue {
 public:
  explicit Connections(std::size_t most) : most_(most) {}
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;
  ~Connections() override = default;

  void enqueue(std::function<void()> task) override {
    {
      const std::scoped_lock lock(mutex_);
      tasks_.push_back(std::move(task));
      if (idle_ < tasks_.size() && threads_.size() < most_) {
        threads_.emplace_back([this] { work(); });
      }
    }
    changed_.notify_one();
  }

  void shutdown() override {
    {
      const std::scoped_lock lock(mutex_);
      done_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      ++idle_;
      changed_.wait(lock, [this] { return done_ || !tasks_.empty(); });
      --idle_;
      if (tasks_.empty()) return;
      const std::function<void()> task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
      lock.lock();
    }
  }

  const std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  std::vector<std::thread> threads_;
  std::size_t idle_ = 0;
  bool done_ = false;
};

/// The stream to one client, within the limits: the library's own stream limits the time for each
/// byte, but not for all of them.
class Client final : public httplib::Stream {
 public:
  Client(int connection, int stopped, const PageLimits& limits)
      : connection_(connection), stopped_(stopped), limits_(limits) {}

  /// Waits for the first byte of a request; false when none comes.
  bool asks() {
    answering_ = false;
    until_ = Clock::now() + limits_.idle;
    if (at_ == end_ && !receive()) return false;
    until_ = Clock::now() + limits_.request;
    return true;
  }

  /// Nothing more arrived, in time or at all.
  bool gone() const { return gone_; }

  /// Discards unread input, so that a client gets its answer before the connection is closed.
  void drain() const {
    std::array<char, 4096> part;
    for (int parts = 0; parts < 64; ++parts) {
      if (::recv(connection_, part.data(), part.size(), MSG_DONTWAIT) <= 0) return;
    }
  }

  bool is_readable() const override { return at_ < end_ || ready(POLLIN, until_); }
  bool is_writable() const override {
    return ready(POLLOUT, answering_ ? until_ : Clock::now() + limits_.answer);
  }

  ssize_t read(char* to, size_t size) override {
    if (at_ == end_ && !receive()) return -1;
    const std::size_t n = std::min(size, end_ - at_);
    std::copy_n(buffer_.data() + at_, n, to);
    at_ += n;
    return static_cast<ssize_t>(n);
  }

  ssize_t write(const char* from, size_t size) override {
    if (!std::exchange(answering_, true)) until_ = Clock::now() + limits_.answer;
    for (;;) {
      if (!ready(POLLOUT, until_)) return -1;
      const ssize_t n = ::send(connection_, from, size, MSG_DONTWAIT | MSG_NOSIGNAL);
      if (n >= 0 || (errno != EINTR && errno != EAGAIN)) return n;
    }
  }

  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return connection_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// Whether it can be read from or written to before `until`, and before the server stops.
  bool ready(short what, Clock::time_point until) const {
    for (;;) {
      std::array<pollfd, 2> all{{{connection_, what, 0}, {stopped_, POLLIN, 0}}};
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
      const int n = ::poll(all.data(), all.size(), static_cast<int>(std::max<long>(left, 0)));
      if (n < 0 && errno == EINTR) continue;
      return n > 0 && all[1].revents == 0 && all[0].revents != 0;
    }
  }

  bool receive() {
    for (;;) {
      gone_ = !ready(POLLIN, until_);
      if (gone_) return false;
      const ssize_t n = ::recv(connection_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
      if (n < 0 && (errno == EINTR || errno == EAGAIN)) continue;
      at_ = 0;
      end_ = n > 0 ? static_cast<std::size_t>(n) : 0;
      gone_ = n <= 0;
      return !gone_;
    }
  }

  const int connection_;
  const int stopped_;
  const PageLimits& limits_;
  Clock::time_point until_;
  bool answering_ = false;
  bool gone_ = false;
  std::array<char, 4096> buffer_{};
  std::size_t at_ = 0;
  std::size_t end_ = 0;
};

/// The library's server with limits on its clients and without ranges: it answers those with
/// status 200, and several of them with a malformed body.
class LimitedServer final : public httplib::Server {
 public:
  explicit LimitedServer(const PageLimits& limits) : limits_(limits) {
    new_task_queue = [this] { return new Connections(limits_.connections); };
  }
  ~LimitedServer() override { ::close(stopped_); }

  /// To be called once bound: the library's backlog is five; a sixth client would retry after a
  /// second.
  void have_many_wait() const { ::listen(svr_sock_, SOMAXCONN); }

  /// Disconnects every client.
  void let_go() const {
    const std::uint64_t once = 1;
    [[maybe_unused]] const ssize_t n = ::write(stopped_, &once, sizeof once);
  }

 private:
  bool process_and_close_socket(socket_t connection) override {
    Client client(connection, stopped_, limits_);
    bool answered = true;
    bool closed = false;
    while (answered && !closed && client.asks()) {
      bool has_body = false;
      answered = process_request(client, false, closed, [&](Request& request) {
        request.ranges.clear();
        has_body = request.has_header("Content-Length") || request.has_header("Transfer-Encoding");
        if (!has_body) return;
        request.headers.erase("Connection");  // a body is not read, nor taken for the next request
        request.set_header("Connection", "close");
      });
      closed = closed || has_body || client.gone();
    }
    client.drain();
    ::shutdown(connection, SHUT_RDWR);
    ::close(connection);
    return answered;
  }

  const PageLimits limits_;
  const int stopped_ = ::eventfd(0, EFD_CLOEXEC);
};

}  // namespace fairway
