#include "scene/gltf/accessors.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace luciole::gltf {

namespace {

/// glTF 2.0, section 3.6.2.2.
enum class ComponentType : uint16_t {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126,
};

uint32_t sizeOf(ComponentType type) {
    switch (type) {
        case ComponentType::int8:
        case ComponentType::uint8:
            return 1;
        case ComponentType::int16:
        case ComponentType::uint16:
            return 2;
        default:
            return 4;
    }
}

ComponentType componentType(const JsonNode& owner) {
    const JsonNode json = owner.at("componentType");
    const uint64_t value = json.integer(5120, 5126);
    if (value == 5124) json.fail("a component type of glTF");
    return ComponentType(value);
}

template <typename T>
T load(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));  // glTF is little-endian, as is every machine with Vulkan
    return value;
}

float asFloat(const std::byte* from, ComponentType type, bool normalized) {
    const auto scaled = [&](float value, float most) { return normalized ? std::max(value / most, -1.0f) : value; };
    switch (type) {
        case ComponentType::int8:
            return scaled(float(load<int8_t>(from)), 127);
        case ComponentType::uint8:
            return scaled(float(load<uint8_t>(from)), 255);
        case ComponentType::int16:
            return scaled(float(load<int16_t>(from)), 32767);
        case ComponentType::uint16:
            return scaled(float(load<uint16_t>(from)), 65535);
        case ComponentType::uint32:
            return scaled(float(load<uint32_t>(from)), 4294967295.0f);
        case ComponentType::float32:
            break;
    }
    return load<float>(from);
}

uint32_t asIndex(const std::byte* from, ComponentType type) {
    switch (type) {
        case ComponentType::uint8:
            return load<uint8_t>(from);
        case ComponentType::uint16:
            return load<uint16_t>(from);
        default:
            return load<uint32_t>(from);
    }
}

bool isUnsigned(ComponentType type) {
    return type == ComponentType::uint8 || type == ComponentType::uint16 || type == ComponentType::uint32;
}

/// Elements of `elementSize` bytes, each `stride` after the one before it.
struct Elements {
    const std::byte* first = nullptr;
    uint64_t stride = 0;

    const std::byte* operator[](uint64_t i) const { return first + i * stride; }
};

/// The elements that begin at `owner`'s byteOffset in its bufferView. All of them are inside.
Elements elementsOf(const JsonNode& owner, Buffers& buffers, uint64_t count, uint64_t elementSize) {
    const BufferView view = buffers.view(owner.at("bufferView"));
    const uint64_t stride = view.stride ? view.stride : elementSize;
    if (stride < elementSize) {
        owner.failWith(fmt::format("expected a byteStride of at least {}, got {}", elementSize, stride));
    }
    const uint64_t size = view.bytes.size();
    if (size < elementSize)
        owner.failWith(fmt::format("expected a buffer view of {} bytes, got {}", elementSize, size));
    const uint64_t offset = integerOr(owner, "byteOffset", 0, 0, size - elementSize);
    const uint64_t fitting = (size - elementSize - offset) / stride + 1;
    if (count > fitting) {
        owner.failWith(
            fmt::format("expected a count of at most {}, as the buffer view ends there, got {}", fitting, count));
    }
    return {view.bytes.data() + offset, stride};
}

}  // namespace

struct Accessors::Layout {
    uint64_t count;
    ComponentType type;
    uint32_t components;
    bool normalized;

    uint64_t elementSize() const { return uint64_t(sizeOf(type)) * components; }
};

Accessors::Layout Accessors::layout(const JsonNode& accessor, uint32_t low, uint32_t high) {
    const JsonNode type = accessor.at("type");
    const auto components = uint32_t(type.choice({"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}) + 1);
    if (components < low || components > high) {
        type.fail(low == high ? fmt::format("{} components", low) : fmt::format("{} to {} components", low, high));
    }
    const JsonNode count = accessor.at("count");
    const uint64_t elements = count.integer(0, ~0ull);
    // Elements with a buffer view are bounded by it.
    const uint64_t limit = accessor.find("bufferView") ? limits_.maxVertices : allowance();
    if (elements > limit) {
        throw Error(ErrorKind::limit,
                    fmt::format("{}: expected at most {} elements, got {}", count.where(), limit, elements));
    }
    return {elements, componentType(accessor), components, booleanOr(accessor, "normalized", false)};
}

uint64_t Accessors::allowance() const {
    constexpr uint64_t kAlways = 1'000'000;
    return std::min(limits_.maxVertices, std::max(kAlways, buffers_.suppliedBytes()));
}

/// Calls `decode(i, bytes)` for element i, twice for one that is replaced by the sparse part (section 3.6.2.3), and not
/// at all for elements that are zero because there is no buffer view.
template <typename Decode>
void Accessors::forEachElement(const JsonNode& accessor, const Layout& layout, const Decode& decode) {
    if (layout.count == 0) return;
    if (accessor.find("bufferView")) {
        const Elements elements = elementsOf(accessor, buffers_, layout.count, layout.elementSize());
        for (uint64_t i = 0; i < layout.count; ++i) decode(i, elements[i]);
    }
    const auto sparse = accessor.find("sparse");
    if (!sparse) return;
    const uint64_t count = sparse->at("count").integer(1, layout.count);
    const JsonNode indices = sparse->at("indices");
    const ComponentType indexType = componentType(indices);
    if (!isUnsigned(indexType)) indices.at("componentType").fail("an unsigned integer type");
    const Elements targets = elementsOf(indices, buffers_, count, sizeOf(indexType));
    const Elements values = elementsOf(sparse->at("values"), buffers_, count, layout.elementSize());
    for (uint64_t i = 0; i < count; ++i) {
        const uint32_t target = asIndex(targets[i], indexType);
        if (target >= layout.count) {
            indices.failWith(fmt::format("expected indices below {}, got {} at {}", layout.count, target, i));
        }
        decode(target, values[i]);
    }
}

Attribute Accessors::floats(const JsonNode& reference, uint32_t low, uint32_t high, bool forceNormalized) {
    const JsonNode accessor = resolve(root_, "accessors", reference);
    const Layout layout = this->layout(accessor, low, high);
    const bool normalized = layout.normalized || forceNormalized;
    const size_t size = sizeOf(layout.type);
    Attribute result{layout.components, std::vector<float>(layout.count * layout.components)};
    forEachElement(accessor, layout, [&](uint64_t element, const std::byte* from) {
        float* to = result.values.data() + element * layout.components;
        for (uint32_t c = 0; c < layout.components; ++c) {
            to[c] = asFloat(from + c * size, layout.type, normalized);
        }
    });
    return result;
}

std::vector<uint32_t> Accessors::indices(const JsonNode& reference) {
    const JsonNode accessor = resolve(root_, "accessors", reference);
    const Layout layout = this->layout(accessor, 1, 1);
    if (!isUnsigned(layout.type)) accessor.at("componentType").fail("an unsigned integer type");
    std::vector<uint32_t> result(layout.count);
    forEachElement(accessor, layout,
                   [&](uint64_t element, const std::byte* from) { result[element] = asIndex(from, layout.type); });
    return result;
}

}  // namespace luciole::gltf
