#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "gpu/pipelines.hpp"
#include "render/lighting/light_index_plan.hpp"

namespace luciole::render {

/// The factor that moves what is in a channel down by one digit.
float blendShift(const shared::IndexPacking& packing);

/// Sends every value through a target of the layout's format, blended as the layout's indices are. \param shift the
/// factor; blendShift \return how many came out wrong
uint32_t wrongValues(const gpu::Context& context, gpu::Pipelines& pipelines, const IndexLayout& layout, float shift);

/// Packing rests on how exactly a device blends, so each packing is tried on the device before its first use; the
/// outcome is kept for the next start in a file of its own for each driver.
class LightIndexSelfTest {
public:
    /// \param cacheFolder empty: nothing is kept
    LightIndexSelfTest(const gpu::Context& context, gpu::Pipelines& pipelines, const std::string& cacheFolder);

    struct Outcome {
        uint32_t wrong;  ///< values
        double ms;       ///< that the test took; 0 if it was run before
    };
    const Outcome& of(const IndexLayout& layout);

private:
    void load();
    void save() const;

    const gpu::Context& context_;
    gpu::Pipelines& pipelines_;
    std::filesystem::path file_;  ///< empty: none
    std::map<std::string, Outcome> outcomes_;
};

}  // namespace luciole::render
