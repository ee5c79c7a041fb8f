// Three kinds of error, kept apart:
//   InputError             bad input from outside, thrown by readers only; the command exits 65.
//   PreconditionViolation  the caller violated what a function requires: a bug (exit 70).
//   the domain's answer (goal unreachable, undecided) is a value, never an exception.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace fairway {

/// `where` is FILE:LINE, FILE: KEY or an option; `what` says what is wrong and what is expected.
class InputError : public std::runtime_error {
 public:
  InputError(std::string where, const std::string& what)
      : std::runtime_error(where.empty() ? what : where + ": " + what), where_(std::move(where)) {}
  const std::string& where() const { return where_; }

 private:
  std::string where_;
};

class PreconditionViolation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws PreconditionViolation when a precondition does not hold. Always on.
inline void require(bool holds, const char* promise) {
  if (!holds) throw PreconditionViolation(promise);
}

}  // namespace fairway
