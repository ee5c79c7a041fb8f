// The machine a table was measured on, and whether it was quiet.
#pragma once

namespace fairway::bench {

/// Prints processor, cores, memory and the load average, and tests whether `threads` threads get as
/// many cores: other processes may take them, or this process may be limited. Warns if the machine
/// is busy.
void print_machine(int threads);

/// The load average of the last minute; negative when unknown.
double load_average();

}  // namespace fairway::bench
