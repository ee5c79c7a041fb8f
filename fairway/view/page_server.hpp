// Serves a run's folder and its live answers on this machine's loopback (docs/report.md).
//
// Properties that always hold:
//   1. Only 127.0.0.1 is bound, and only requests that name it (or localhost) as their host are
//      answered. A browser's request from another page (Sec-Fetch-Site) is refused, so that no
//      other site can have plans made.
//   2. Only a run's products are served, by their own names, and only regular files: links are not
//      followed, paths cannot be given.
//   3. A slow or silent client is disconnected after `PageLimits`, and keeps no other waiting: each
//      has its own thread, as long as there are no more than `connections`.
//   4. Every answer except a product is a JSON object; errors are {"error": ...} with status 400
//      (malformed), 403 (another host), 404 (unknown), 405 (anything but GET and HEAD), 500, or 503
//      (another plan or proof is being made). A product is sent whole: Range is ignored.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace fairway {

class LiveEngine;

struct PageLimits {
  std::chrono::milliseconds idle{5'000};      ///< until a connection begins its next request
  std::chrono::milliseconds request{5'000};   ///< for the whole of a request, from its first byte
  std::chrono::milliseconds answer{120'000};  ///< for the whole of an answer
  std::size_t connections = 128;              ///< at once; others wait for their turn
};

class PageServer {
 public:
  /// Binds the port, 0 for a free one; answers are given once serve() runs. Throws InputError when
  /// the port is taken. `engine` must outlive this object.
  PageServer(std::filesystem::path folder, const LiveEngine& engine, int port,
             PageLimits limits = {});
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  int port() const;
  std::string address() const;  ///< "http://127.0.0.1:PORT/"

  /// Answers until stop() is called, from any thread.
  void serve();
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace fairway
