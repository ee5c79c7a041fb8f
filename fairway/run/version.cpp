#include "fairway/run/version.hpp"

namespace fairway {

const char* const program_version = "fairway " FAIRWAY_VERSION;

}  // namespace fairway
