// What Ctrl-C does: a signal ends the process at once, unless a command that runs until it is
// stopped has registered a way to stop itself.
#pragma once

#include <functional>
#include <string>

namespace fairway {

/// During its lifetime SIGINT, SIGTERM and SIGHUP call `end`, from a separate thread, instead of
/// ending the process; a second signal ends it anyway. Only one may exist at a time.
class EndsGently {
 public:
  explicit EndsGently(std::function<void()> end);
  ~EndsGently();
  EndsGently(const EndsGently&) = delete;
  EndsGently& operator=(const EndsGently&) = delete;
};

/// The message printed to stderr when a signal ends the process at once.
void say_when_interrupted(std::string words);
[[nodiscard]] std::string words_when_interrupted();

/// Called on every signal; true when the command stops by itself.
[[nodiscard]] bool ends_gently();

}  // namespace fairway
