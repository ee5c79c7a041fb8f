// One libFuzzer program per reader; FAIRWAY_FUZZ_READER names the reader.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz/read_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  fairway::feed(FAIRWAY_FUZZ_READER, {reinterpret_cast<const char*>(bytes), size});
  return 0;
}
