// Manners for GDAL and GEOS while one of our calls runs in this thread: errors and warnings are
// remembered, not printed; rasters may run south-up; no sidecar files are looked for; nothing is
// fetched from a network.
#pragma once

#include <string>
#include <vector>

namespace fairway {

class GdalSession {
 public:
  GdalSession();
  ~GdalSession();
  GdalSession(const GdalSession&) = delete;
  GdalSession& operator=(const GdalSession&) = delete;

  /// The last failure GDAL spoke of, or empty.
  const std::string& message() const { return message_; }

  /// Every different warning, in their order.
  const std::vector<std::string>& warnings() const { return warnings_; }

  void remember(const char* message) { message_ = message; }
  void remember_warning(const char* message);

 private:
  std::string message_;
  std::vector<std::string> warnings_;
};

}  // namespace fairway
