// Settings for GDAL and GEOS while one of our calls runs in this thread: errors and warnings are
// stored, not printed; rasters may run south-up; sidecar files are ignored; nothing is fetched
// from a network.
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

  /// The last failure that GDAL reported, or empty.
  const std::string& message() const { return message_; }

  /// Every distinct warning, in order.
  const std::vector<std::string>& warnings() const { return warnings_; }

  void remember(const char* message) { message_ = message; }
  void remember_warning(const char* message);

 private:
  std::string message_;
  std::vector<std::string> warnings_;
};

}  // namespace fairway
