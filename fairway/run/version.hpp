// The name and version that products carry.
#pragma once

namespace fairway {

extern const char* const program_version;  ///< "fairway 0.1.0"

}  // namespace fairway
