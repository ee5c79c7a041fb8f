// Reads a request's parameters, strictly.
#pragma once

#include <initializer_list>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "fairway/base/grid.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// A malformed question: what is wrong, and what is expected.
class BadQuestion : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Decoded parameters as received, repeated ones repeated.
using Parameters = std::multimap<std::string, std::string>;

/// Throws BadQuestion unless the parameters are exactly `names`, each once.
void require_parameters(const Parameters& parameters, std::initializer_list<const char*> names);

/// The whole text as a finite decimal number. Throws BadQuestion.
[[nodiscard]] double number_parameter(const Parameters& parameters, const char* name);

/// A place given by the parameters x and y, anywhere. Throws BadQuestion.
[[nodiscard]] Vec2 place_parameters(const Parameters& parameters, const char* x, const char* y);

/// A state given by the parameters x, y, h: metres, radians; anywhere. Throws BadQuestion.
[[nodiscard]] State state_parameters(const Parameters& parameters, const char* x, const char* y,
                                     const char* h);

/// The same for a state on the grid.
[[nodiscard]] State state_parameters(const Parameters& parameters, const Grid& grid, const char* x,
                                     const char* y, const char* h);

/// Whether a Host header names this machine's loopback with this port: so no page from elsewhere
/// can reach the server under a name of its own that resolves here.
[[nodiscard]] bool is_local_host(std::string_view host, int port);

}  // namespace fairway
