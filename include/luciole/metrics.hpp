#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include <luciole/image.hpp>
#include <luciole/math.hpp>

/// How far a picture is from a reference. docs/compare.md says what each number is good for. All functions throw Error(usage) if the
/// images have no pixels or differ in shape, or if theirs is none that the function knows; the message gives both.
namespace luciole {

/// Relative error of each pixel: the largest over the channels of |test - reference| / (|reference| + floor), with `floor` a hundredth
/// of the mean of |reference| over the picture, so that dark pixels count by what an eye would see.
/// \param reference, test linear values, any number of channels; NaN and infinite ones do not count for the mean
/// \return 1 channel; 1 stands for 100 %; infinite where a value of either picture is NaN or infinite, and only there
Image relativeError(const Image& reference, const Image& test);

struct ErrorSummary {
    double mean = 0;
    double p999 = 0;   ///< 99.9 % of the pixels are at or below it
    double max = 0;
    double share = 0;  ///< pixels that count here, of all
};

/// \param errors 1 channel; \param mask pixels that count; null: all. No pixels have no errors
ErrorSummary summaryOf(const Image& errors, const std::vector<bool>* mask = nullptr);

/// Peak signal-to-noise ratio: 10 log10(1 / mean squared difference), over all pixels and channels. \param reference, test in [0, 1]
/// \return dB; infinite for equal pictures
double psnr(const Image& reference, const Image& test);

/// Structural similarity. Wang, Bovik, Sheikh and Simoncelli 2004, "Image Quality Assessment: From Error Visibility to Structural
/// Similarity", section III: windows of 11 x 11 pixels weighted by a Gaussian of sigma 1.5, K1 = 0.01, K2 = 0.03. The mean over the channels
/// and over the pixels whose window lies inside the picture; along a side of fewer than 11 pixels all, the edge going on beyond.
/// \param reference, test display values, [0, 1]
/// \return [-1, 1]; 1 for equal pictures
double ssim(const Image& reference, const Image& test);

/// Pixels in a degree of sight at 0.7 m from a monitor 0.7 m and 3840 pixels wide (Andersson et al. 2020, section 6).
inline constexpr double kFlipPixelsPerDegree = 3840 * kPi / 180;

/// What an observer perceives at each pixel who flips between the pictures in one place. Andersson, Nilsson, Akenine-Moeller, Oskarsson,
/// Astroem and Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images", all of section 4, with its constants.
/// \param reference, test display values, sRGB, [0, 1], 3 channels; \param pixelsPerDegree > 0
/// \return 1 channel, [0, 1]: 0 equal, 1 the largest difference of colour that a display can show
Image flip(const Image& reference, const Image& test, double pixelsPerDegree = kFlipPixelsPerDegree);

/// The same for radiance: at each pixel the largest FLIP error over exposures a stop or less apart. Andersson, Nilsson, Shirley and
/// Akenine-Moeller 2021, "Visualizing Errors in Rendered High Dynamic Range Images", section 3: from the exposure that shows the reference's
/// largest luminance at 85 % to the one that shows its median there, by Narkowicz' fit of ACES. If more than half of the reference is
/// black, where the paper has no last exposure, the median is that of the rest. Takes as long as flip for each stop between the two.
/// \param reference, test linear Rec. 709, 3 channels, finite; what is below 0 counts as black
/// \return as flip
Image hdrFlip(const Image& reference, const Image& test, double pixelsPerDegree = kFlipPixelsPerDegree);

enum class PixelValues {
    radiance,  ///< linear Rec. 709; 4 channels: the last is alpha
    display,   ///< sRGB-encoded, [0, 1]; 4 channels: the last is alpha
    numbers,   ///< anything else: depth, a normal, an index
};

/// All of the above for one pair of pictures. Those with other than 3 or 4 channels are compared as numbers.
struct ImageDifference {
    bool identical = false;        ///< in each value of each pixel; never with a NaN
    uint64_t notFinite = 0;        ///< pixels at which a value of either picture is NaN or infinite
    uvec2 firstNotFinite{0};       ///< the first of them in reading order
    Image relativeErrorMap;        ///< in linear light
    ErrorSummary relativeError;    ///< of the finite pixels
    std::optional<double> psnr;    ///< this and what follows: not of numbers, and only if all pixels are finite
    std::optional<double> ssim;
    std::optional<Image> flipMap;  ///< of radiance that of hdrFlip
    ErrorSummary flip;
};

/// \param exposureEv stops; for PSNR and SSIM, radiance becomes display values without a tone curve: exposed, cut at 1, sRGB-encoded
ImageDifference compareImages(const Image& reference, const Image& test, PixelValues values, float exposureEv = 0);

/// A difference for people: the relative error as a heat map and, if there is one, the FLIP error beside it, in full resolution, each
/// with a legend below. Relative errors from the 99.9th percentile, rounded up, have the last colour; pixels that are not finite are grey.
/// \return sRGB-encoded, [0, 1], 3 channels
Image differenceMap(const ImageDifference& difference);

}  // namespace luciole
