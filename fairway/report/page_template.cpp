#include "fairway/report/page_template.hpp"

// The bundle is embedded in the program, so that a command copied elsewhere still has its page.
// `.incbin` takes 700 kB instantly, where an array of numbers takes the compiler many seconds.
__asm__(
    ".pushsection .rodata\n"
    ".global fairway_page_template_begin\n"
    ".global fairway_page_template_end\n"
    "fairway_page_template_begin:\n"
    ".incbin \"" FAIRWAY_PAGE_TEMPLATE
    "\"\n"
    "fairway_page_template_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" {
extern const char fairway_page_template_begin;
extern const char fairway_page_template_end;
}

namespace fairway {

std::string_view page_template() {
  const char* begin = &fairway_page_template_begin;
  return {begin, static_cast<std::size_t>(&fairway_page_template_end - begin)};
}

bool has_page_template() { return page_template().starts_with("<!doctype html>"); }

}  // namespace fairway
