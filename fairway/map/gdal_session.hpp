// Manners for GDAL and GEOS while one of our calls runs in this thread: errors are remembered, not
// printed; no sidecar files are looked for; nothing is fetched from a network.
#pragma once

#include <string>

namespace fairway {

class GdalSession {
 public:
  GdalSession();
  ~GdalSession();
  GdalSession(const GdalSession&) = delete;
  GdalSession& operator=(const GdalSession&) = delete;

  /// The last failure GDAL spoke of, or empty.
  const std::string& message() const { return message_; }

  void remember(const char* message) { message_ = message; }

 private:
  std::string message_;
};

}  // namespace fairway
