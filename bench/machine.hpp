// The machine a table was measured on, and whether it was quiet.
#pragma once

namespace fairway::bench {

/// Prints processor, cores, memory and the load average; warns when others are at work.
void print_machine();

}  // namespace fairway::bench
