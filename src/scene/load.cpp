#include "io/file.hpp"
#include "scene/builtin/builtin.hpp"

#include <luciole/scene_io.hpp>

namespace luciole {

Scene loadScene(const std::string& uri, const LoadOptions& options) {
    if (uri.starts_with("builtin:")) return makeBuiltin(uri);
    const std::filesystem::path file(uri);
    const std::vector<std::byte> bytes = readFile(file, options.limits.maxFileBytes);
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    return loadGltf(bytes, uri, folder, options);
}

}  // namespace luciole
