// The machine a table was measured on, and whether it was quiet.
#pragma once

namespace fairway::bench {

/// Prints processor, cores, memory and the load average; warns when others are at work.
/// Names the machine and its load, and tries whether `threads` threads get as many cores: others on
/// the machine may take them, or only some may be allowed to this process.
void print_machine(int threads);

/// The load average of the last minute; negative when unknown.
double load_average();

}  // namespace fairway::bench
