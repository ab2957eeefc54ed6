#pragma once
#include <vector>

#include <luciole/scene.hpp>

namespace luciole::reference {

/// One row of the table of functions (docs/conventions.md, "The table"): 4097 samples, linear in between, because that
/// is what the functions are by definition, here as on the device.
class FunctionTable {
public:
    /// \param low low end of the domain [low, 1]: -1 for dot products and cosines, 0 for attenuation
    FunctionTable(const Function& function, double low);

    /// (shape, cascade); `x` is clamped to the domain.
    dvec2 operator()(double x) const;

private:
    double low_;
    std::vector<dvec2> samples_;
};

/// All functions of a scene, each over both domains; 128 KiB per function.
class FunctionTables {
public:
    explicit FunctionTables(const Scene& scene);

    const FunctionTable& ofCosine(uint32_t function) const { return ofCosine_[function]; }      ///< domain [-1, 1]
    const FunctionTable& ofDistance(uint32_t function) const { return ofDistance_[function]; }  ///< domain [0, 1]

private:
    std::vector<FunctionTable> ofCosine_, ofDistance_;
};

}  // namespace luciole::reference
