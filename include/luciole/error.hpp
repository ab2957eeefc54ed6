#pragma once
#include <stdexcept>
#include <string>
#include <utility>

namespace luciole {

/// What went wrong, as the caller has to tell it apart. The value is the exit code of the command line.
enum class ErrorKind : int {
    usage = 2,       ///< an argument or a setting is wrong
    scene = 3,       ///< a scene or rig file breaks a rule
    io = 4,          ///< a file can't be read or written
    device = 5,      ///< no usable Vulkan device
    deviceLost = 6,  ///< device lost, or out of memory
    limit = 8,       ///< the input is valid and exceeds a limit; the message gives both numbers
};

/// The one exception type of the library. The message says where, what was expected, what was found:
/// `hall.gltf: /extensions/KHR_lights_punctual/lights/3/range: expected > 0, got -1`.
class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, std::string message) : std::runtime_error(std::move(message)), kind_(kind) {}
    ErrorKind kind() const noexcept { return kind_; }

private:
    ErrorKind kind_;
};

}  // namespace luciole
