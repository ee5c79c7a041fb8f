#include "fairway/app/ending.hpp"

#include <mutex>
#include <utility>

namespace fairway {
namespace {

std::mutex guard;
std::function<void()> wanted;  // guarded, like the words
std::string last_words;

}  // namespace

EndsGently::EndsGently(std::function<void()> end) {
  const std::lock_guard lock(guard);
  wanted = std::move(end);
}

EndsGently::~EndsGently() {
  const std::lock_guard lock(guard);
  wanted = nullptr;
}

void say_when_interrupted(std::string words) {
  const std::lock_guard lock(guard);
  last_words = std::move(words);
}

std::string words_when_interrupted() {
  const std::lock_guard lock(guard);
  return last_words;
}

bool ends_gently() {
  // Under the lock, so that what `end` refers to lives until it returns.
  const std::lock_guard lock(guard);
  const auto end = std::exchange(wanted, nullptr);  // the second signal finds none
  if (!end) return false;
  end();
  return true;
}

}  // namespace fairway
