#pragma once
#include <string>

#include <luciole/scene.hpp>

namespace luciole {

/// Makes a built-in scene from `builtin:NAME?key=value&...`; see builtinScenes(). The same URI gives the same scene.
/// \throws Error(usage) naming the URI, the key, what was expected and what was found
Scene makeBuiltin(const std::string& uri);

}  // namespace luciole
