#pragma once
#include <cstdint>
#include <vector>

#include "scene/gltf/files.hpp"

namespace luciole::gltf {

/// Elements of one accessor as floats, [element][component].
struct Attribute {
    uint32_t components = 0;  ///< 1 to 4
    std::vector<float> values;

    size_t count() const { return components ? values.size() / components : 0; }
    const float* operator[](size_t element) const { return values.data() + element * components; }
};

/// Decodes accessors (glTF 2.0, section 3.6.2): every component type, normalised, interleaved and sparse, or zeros
/// where there is no buffer view. Every range is checked before it is read; floats come out as they are stored.
class Accessors {
public:
    Accessors(const JsonNode& root, Buffers& buffers, const LoadLimits& limits)
        : root_(root), buffers_(buffers), limits_(limits) {}

    /// The accessor that `reference` is the index of, with as many components as one in [low, high]. Integers stand for
    /// [0, 1] or [-1, 1] if the accessor says `normalized` or `forceNormalized` is set.
    Attribute floats(const JsonNode& reference, uint32_t low, uint32_t high, bool forceNormalized = false);
    /// The accessor of unsigned integer scalars that `reference` is the index of.
    std::vector<uint32_t> indices(const JsonNode& reference);

    /// How many elements may be decoded in all, of one kind: as many as the buffers read so far have bytes, for a small file
    /// can ask for many by zeros that no buffer holds and by naming one buffer often.
    uint64_t allowance() const;

private:
    struct Layout;
    Layout layout(const JsonNode& accessor, uint32_t low, uint32_t high);
    template <typename Decode>
    void forEachElement(const JsonNode& accessor, const Layout& layout, const Decode& decode);

    JsonNode root_;
    Buffers& buffers_;
    const LoadLimits& limits_;
};

}  // namespace luciole::gltf
