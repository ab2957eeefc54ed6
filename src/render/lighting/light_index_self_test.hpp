#pragma once
#include <string>

#include "gpu/pipelines.hpp"
#include "render/driver_cache.hpp"
#include "render/lighting/light_index_plan.hpp"

namespace luciole::render {

/// The factor that moves what is in a channel down by one digit.
float blendShift(const shared::IndexPacking& packing);

/// Sends every value through a target of the layout's format, blended as the layout's indices are. \param shift the
/// factor; blendShift \return how many came out wrong
uint32_t wrongValues(const gpu::Context& context, gpu::Pipelines& pipelines, const IndexLayout& layout, float shift);

/// Packing rests on how exactly a device blends, so each packing is tried on the device before its first use; the
/// outcome is kept for the next start.
class LightIndexSelfTest {
public:
    /// \param cacheFolder empty: nothing is kept
    LightIndexSelfTest(const gpu::Context& context, gpu::Pipelines& pipelines, const std::string& cacheFolder);

    struct Outcome {
        uint32_t wrong;  ///< values
        double ms;       ///< that the test took; 0 if it was run before
    };
    Outcome of(const IndexLayout& layout);

private:
    const gpu::Context& context_;
    gpu::Pipelines& pipelines_;
    DriverCache cache_;
};

}  // namespace luciole::render
