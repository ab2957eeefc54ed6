#pragma once
#include <cstdint>
#include <functional>

namespace luciole {

/// Calls `work(row)` once for each row in [0, rows), on as many threads as the machine has, in no particular order, and
/// waits. What `work` throws is thrown on by the caller's thread, and no further rows are started.
/// \param progress called with the share done from the calling thread; false stops. May be empty
/// \return false if stopped
bool forEachRow(uint32_t rows, const std::function<void(uint32_t)>& work, const std::function<bool(double)>& progress);

}  // namespace luciole
