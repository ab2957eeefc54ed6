#include "outputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <luciole/error.hpp>
#include <set>
#include <system_error>

#include "interrupt.hpp"

namespace luciole::cli {
namespace {

namespace fs = std::filesystem;

bool isExr(const fs::path& file) { return hasExtension(file, ".exr"); }

void checkAovs(const OutputOptions& options) {
    if (options.aovs.empty()) return;
    const auto& known = aovNames();
    for (const std::string& aov : options.aovs)
        if (std::find(known.begin(), known.end(), aov) == known.end())
            throw Error(ErrorKind::usage,
                        fmt::format("--aov: expected some of {}, got \"{}\"", fmt::join(known, ", "), aov));
    if (std::none_of(options.files.begin(), options.files.end(), isExr))
        throw Error(ErrorKind::usage, "--aov: PNG has no layers; add an output that ends in .exr");
}

}  // namespace

void addOutputOptions(CLI::App& command, OutputOptions& options) {
    command.add_option("-o,--output", options.files, "picture to write, .png (as shown) or .exr (linear); repeatable")
        ->type_name("FILE")
        ->required()
        ->allow_extra_args(false)
        ->group("Output");
    addParsed(
        command, "--view",
        [&](const std::string& text) {
            if (text != "picture" && text != "overlap" && text != "clusters")
                throw Error(ErrorKind::usage, fmt::format("--view: expected picture, overlap or clusters, got \"{}\"", text));
            options.shown = text == "picture" ? Shown::picture : text == "overlap" ? Shown::overlap : Shown::clusters;
        },
        "overlap: heat maps of the lights evaluated and the lights that reach each pixel; clusters: the lists of lights of tiled and clustered techniques [picture]")
        ->type_name("picture|overlap|clusters")
        ->group("Output");
    addParsed(
        command, "--bits",
        [&](const std::string& text) {
            if (text != "8" && text != "16")
                throw Error(ErrorKind::usage, fmt::format("--bits: expected 8 or 16, got \"{}\"", text));
            options.bits = text == "8" ? 8 : 16;
        },
        "bits per channel of PNG [8]")
        ->type_name("8|16")
        ->group("Output");
    addParsed(
        command, "--exr-type",
        [&](const std::string& text) {
            if (text != "half" && text != "float")
                throw Error(ErrorKind::usage, fmt::format("--exr-type: expected half or float, got \"{}\"", text));
            options.exrType = text == "half" ? ExrType::half : ExrType::float32;
        },
        "numbers of EXR [half]")
        ->type_name("half|float")
        ->group("Output");
    command.add_option("--aov", options.aovs, fmt::format("more layers for EXR: {}", fmt::join(aovNames(), ", ")))
        ->type_name("NAME,...")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->group("Output");
    command.add_option("--dump-graph", options.graphFile, "write the frame graph in Graphviz's language")
        ->type_name("FILE.dot")
        ->group("Output");
}

void checkOutputs(const OutputOptions& options) {
    std::set<fs::path> seen;
    const auto check = [&](const fs::path& file) {
        requireWritable(file);
        std::error_code code;
        const fs::path resolved = fs::weakly_canonical(fs::absolute(file, code), code);
        if (!code && !seen.insert(resolved).second)
            throw Error(ErrorKind::usage, fmt::format("{}: named twice as output", file.string()));
    };
    for (const fs::path file : options.files) {
        if (!isExr(file) && !hasExtension(file, ".png"))
            throw Error(ErrorKind::usage, fmt::format("{}: expected a name that ends in .png or .exr", file.string()));
        check(file);
    }
    checkAovs(options);
    if (!options.graphFile.empty()) check(options.graphFile);
}

std::vector<std::string> neededAovs(const OutputOptions& options) {
    std::vector<std::string> names = options.aovs;
    std::vector<const char*> shown;
    if (options.shown == Shown::overlap) shown = {"evaluations", "useful-evaluations"};
    if (options.shown == Shown::clusters) shown = {"list-length", "list-slice"};
    for (const char* name : shown)
        if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
    return names;
}

void writeOutputs(const OutputOptions& options, const Frame& frame) {
    for (const fs::path file : options.files) {
        const FinishFirst guard;
        if (isExr(file)) {
            std::map<std::string, Image> layers = frame.aovs;
            layers[""] = frame.radiance;
            writeExr(file, layers, options.exrType);
        } else if (options.shown == Shown::overlap) {
            const Image map = overlapHeatMap(frame.aovs.at("evaluations"), frame.aovs.at("useful-evaluations"));
            writePng(file, map, options.bits);
        } else if (options.shown == Shown::clusters) {
            const Image map = lightListMap(frame.aovs.at("list-length"), frame.aovs.at("list-slice"), frame.stats.lightLists->tileSize);
            writePng(file, map, options.bits);
        } else {
            writePng(file, frame.display, options.bits);
        }
    }
    if (!options.graphFile.empty()) {
        const FinishFirst guard;
        writeFileAtomically(options.graphFile, std::as_bytes(std::span(frame.graph)));
    }
}

bool hasExtension(const fs::path& file, std::string_view wanted) {
    const std::string extension = file.extension().string();
    return std::equal(extension.begin(), extension.end(), wanted.begin(), wanted.end(),
                      [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

void requireWritable(const fs::path& file) {
    const auto fail = [&](int code) {
        throw Error(ErrorKind::io,
                    fmt::format("{}: can't write: {}", file.string(), std::generic_category().message(code)));
    };
    std::error_code code;
    const fs::file_status target = fs::status(file, code);
    if (fs::is_directory(target)) fail(EISDIR);
    if (target.type() == fs::file_type::none) fail(code.value());  // a name that is too long, a loop of links
    if (fs::exists(target) && !fs::is_regular_file(target))
        throw Error(ErrorKind::io, fmt::format("{}: can't write: not a regular file", file.string()));
    if (fs::exists(target) && ::access(file.c_str(), W_OK) != 0) fail(errno);
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    const fs::file_status status = fs::status(folder, code);
    if (!fs::is_directory(status)) fail(fs::exists(status) ? ENOTDIR : code.value());
    if (::access(folder.c_str(), W_OK | X_OK) != 0) fail(errno);
}

}  // namespace luciole::cli
