// What Ctrl-C does: a signal ends the process at once, unless a command that runs for as long as
// it is wanted has said how it ends by itself.
#pragma once

#include <functional>
#include <string>

namespace fairway {

/// While it lives, SIGINT, SIGTERM and SIGHUP call `end`, from a thread of their own, instead of
/// ending the process; a second signal ends it all the same. One at a time.
class EndsGently {
 public:
  explicit EndsGently(std::function<void()> end);
  ~EndsGently();
  EndsGently(const EndsGently&) = delete;
  EndsGently& operator=(const EndsGently&) = delete;
};

/// What a signal that ends the process at once leaves to say, on stderr.
void say_when_interrupted(std::string words);
[[nodiscard]] std::string words_when_interrupted();

/// Called with every signal; true when a command ends by itself.
[[nodiscard]] bool ends_gently();

}  // namespace fairway
