#include "fairway/steer/testing/heap_uses.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> uses{0};

}  // namespace

void* operator new(std::size_t size) {
  ++uses;
  if (void* place = std::malloc(size > 0 ? size : 1)) return place;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++uses;
  return std::malloc(size > 0 ? size : 1);
}
void operator delete(void* place) noexcept { std::free(place); }
void operator delete(void* place, std::size_t) noexcept { std::free(place); }

namespace fairway::testing {

std::size_t heap_uses() { return uses; }

}  // namespace fairway::testing
