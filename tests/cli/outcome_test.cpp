// Exit codes and error messages, one class of failure after the other.
#include <doctest/doctest.h>

#include <algorithm>
#include <report_template.hpp>
#include <luciole/error.hpp>

#include "cli/run.hpp"
#include "io/temporary_folder.hpp"

using namespace luciole;
using namespace luciole::test;

namespace {

/// A failure as it has to look: its exit code, nothing on stdout, one line on stderr.
Run failing(ErrorKind kind, const std::vector<std::string>& arguments,
            const std::vector<std::string>& environment = {}) {
    const Run run = runLuciole(arguments, environment);
    CHECK(run.exitCode == int(kind));
    CHECK(run.out.empty());
    CHECK(run.err.starts_with("luciole: error: "));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    return run;
}

/// `luciole render builtin:materials` to `file` without a device, and more.
std::vector<std::string> renderTo(const std::string& file, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"render", "builtin:materials", "--lighting", "reference", "-q", "-o", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

}  // namespace

TEST_CASE("cli: wrong arguments end with 2 and a line that names the argument, and write nothing") {
    const TemporaryFolder folder;
    const std::string png = folder / "a.png", exr = folder / "a.exr";
    std::filesystem::create_symlink(".", folder / "link");
    const struct {
        std::vector<std::string> more;
        std::string_view message;
    } rows[] = {
        {{"--size", "0x0"}, "--size: expected WIDTHxHEIGHT, each from 1 to 16384, got \"0x0\""},
        {{"--size", "16385x1"}, "--size"},
        {{"--size", "-1x1"}, "--size"},
        {{"--size", "nanxnan"}, "--size"},
        {{"--size", "64"}, "--size"},
        {{"--size", "64x64x64"}, "--size"},
        {{"--size", "99999999999x1"}, "--size"},
        {{"--exposure", "nan"}, "error: --exposure: expected a number"},
        {{"--exposure", "1e9"}, "--exposure"},
        {{"--tonemap", "warm"}, "error: --tonemap: expected one of none, reinhard, aces, agx, got \"warm\""},
        {{"--gbuffer", "huge"}, "--gbuffer"},
        {{"--light-buffer", "rgb8"}, "--light-buffer"},
        {{"--measure=maybe"}, "--measure: expected on or off"},
        {{"--fov", "180"}, "--fov"},
        {{"--fov", "nan"}, "--fov"},
        {{"--look-at", "0,0,0,1,1"}, "--look-at: expected 6 numbers"},
        {{"--look-at", "0,0,0,inf,0,0"}, "--look-at"},
        {{"--look-at", "1,2,3,1,2,3"}, "--look-at"},
        {{"--camera", "no such camera"}, "--camera"},
        {{"--camera", "99"}, "--camera"},
        {{"--camera", "-1"}, "--camera"},
        {{"--view", "heat"}, "--view: expected picture, overlap or clusters, got \"heat\""},
        {{"--view", "clusters"}, "--view clusters: expected one of --lighting auto, tiled, tiled-points, clustered, clustered-forward, which make lists of lights, got"},
        {{"--aov", "list-length", "-o", exr}, "--aov list-length, list-slice: expected one of --lighting auto, tiled,"},
        {{"--bits", "10"}, "--bits"},
        {{"--exr-type", "double"}, "--exr-type"},
        {{"--default-light", "on"}, "--default-light"},
        {{"--aov", "depth"}, "--aov: PNG has no layers"},
        {{"--aov", "smell", "-o", exr}, "--aov: expected some of depth"},
        {{"--dump-graph", folder / "a.dot"}, "--dump-graph"},
        {{"-o", png}, "named twice"},
        {{"-o", folder / "link/a.png"}, "named twice"},
        {{"-o", folder / "a.jpg"}, "a.jpg: expected a name that ends in .png or .exr"},
        {{"--shine"}, "--shine"},
        {{"another"}, "another"},
        {{"--verbose"}, "--quiet"},
    };
    for (const auto& row : rows) {
        CAPTURE(row.message);
        const Run run = failing(ErrorKind::usage, renderTo(png, row.more));
        CHECK(has(run.err, row.message));
    }
    // The graph may not take the picture's place either.
    CHECK(has(failing(ErrorKind::usage, {"render", "builtin:materials", "-o", png, "--dump-graph", png}).err, "twice"));
    CHECK(folder.count() == 1);  // the link
}

TEST_CASE("cli: unknown techniques, commands and built-in scenes end with 2") {
    const TemporaryFolder folder;
    const std::string png = folder / "a.png";
    const Run magic = failing(ErrorKind::usage, {"render", "builtin:materials", "-o", png, "--lighting", "magic"});
    CHECK(has(magic.err, "error: --lighting: expected one of "));
    CHECK(has(magic.err, "reference"));
    const Run ideal = failing(ErrorKind::usage, {"render", "builtin:materials", "-o", png, "--lighting", "ideal"});
    CHECK(has(ideal.err, "error: --lighting: expected one of "));  // benchmarks alone have it
    CHECK(has(failing(ErrorKind::usage, {"bench", "builtin:materials", "--lighting", "tiled,magic"}).err, "--lighting: expected one of "));
    const auto refused = [](std::vector<std::string> arguments, const char* message) {
        arguments.insert(arguments.begin(), "bench");
        CHECK(has(failing(ErrorKind::usage, arguments).err, message));
    };
    CHECK(has(failing(ErrorKind::usage, {"graph", "builtin:hall", "-o", "frame.png"}).err, "frame.png: expected a name that ends in .svg or .dot"));
    CHECK(has(failing(ErrorKind::usage, {"graph", "builtin:hall", "-o", "frame.dot", "--lighting", "reference"}).err, "the reference has no frame graph"));
    CHECK(has(failing(ErrorKind::usage, {"compare", "builtin:hall", "-o", "report.html", "--psnr", "40"}).err, "--psnr: not for a scene"));
    CHECK(has(failing(ErrorKind::usage, {"compare", "a.exr", "b.exr", "--lighting", "tiled"}).err, "--lighting: not for two pictures"));
    if (!reportTemplate().empty()) {
        CHECK(has(failing(ErrorKind::usage, {"compare", "builtin:hall"}).err, "compare: -o FILE.html is required for a scene"));
        CHECK(has(failing(ErrorKind::usage, {"compare", "builtin:hall", "-o", "report.pdf"}).err, "report.pdf: expected a name that ends in .html"));
    }
    refused({}, "SCENE is required, or --reproduce");
    refused({"--reproduce", "folklore"}, "--reproduce: expected one of trebilco, olsson, mjp, got \"folklore\"");
    refused({"builtin:hall", "--sweep", "lights"}, "--sweep: expected NAME=VALUE,VALUE,..., got \"lights\"");
    refused({"builtin:hall", "--sweep", "lights=1,,2"}, "--sweep: expected NAME=VALUE,VALUE,...");
    refused({"builtin:hall", "--sweep", "lamps=1"}, "--sweep: expected size, a setting or a parameter of builtin:hall, lights, ");
    refused({"builtin:hall?lights=3", "--sweep", "lights=1"}, "--sweep lights: builtin:hall?lights=3 gives it already");
    refused({"builtin:hall", "--sweep", "lights=-1"}, "--sweep lights: expected 0 to 1048576, got -1");
    refused({"builtin:hall", "--sweep", "msaa=3"}, "--sweep msaa: expected ");
    refused({"builtin:hall", "--sweep", "lighting=tiled"}, "--sweep: techniques are named by --lighting");
    refused({"model.glb", "--sweep", "lights=1"}, "--sweep: expected size, a setting or, for built-in scenes, one of their parameters, got \"lights\" for model.glb");
    refused({"builtin:hall", "--seconds", "0"}, "--seconds: expected above 0");
    refused({"builtin:hall", "-o", "figures.txt"}, "figures.txt: expected a name that ends in .json, .csv or .md");
    CHECK(has(failing(ErrorKind::usage, {"bench", "builtin:materials", "--frames", "0"}).err, "--frames: expected a whole number from 1 to 1000"));
    CHECK(has(failing(ErrorKind::usage, {}).err, "command"));
    CHECK(has(failing(ErrorKind::usage, {"paint"}).err, "paint (see luciole --help)"));
    CHECK(has(failing(ErrorKind::usage, {"render", "builtin:materials"}).err, "(see luciole render --help)"));
    failing(ErrorKind::usage, {"render", "-o", png});
    failing(ErrorKind::usage, {"info", "builtin:castle"});
    failing(ErrorKind::usage, {"info", "builtin:hall?lights=-1"});
    failing(ErrorKind::usage, {"scene", "builtin:materials", "-o", folder / "a.gltf"});
    CHECK(folder.count() == 0);
}

TEST_CASE("cli: a faulty settings file ends with 2, a missing one with 4") {
    const TemporaryFolder folder;
    const std::string settings = folder / "settings.json";
    writeText(settings, R"({"tonemap": "warm"})");
    CHECK(has(failing(ErrorKind::usage, renderTo(folder / "a.png", {"--settings", settings})).err, "/tonemap"));
    const std::string lighting = folder / "lighting.json";
    writeText(lighting, R"({"lighting": "magic"})");
    const Run magic =
        failing(ErrorKind::usage, {"render", "builtin:materials", "-o", folder / "a.png", "--settings", lighting});
    CHECK(has(magic.err, "lighting.json: /lighting: expected one of "));
    CHECK(has(failing(ErrorKind::io, renderTo(folder / "a.png", {"--settings", folder / "none.json"})).err,
              "No such file"));
    CHECK(has(failing(ErrorKind::io, renderTo(folder / "a.png", {"--settings", folder.path()})).err, "Is a directory"));
    failing(ErrorKind::limit, renderTo(folder / "a.png", {"--settings", "/dev/zero"}));
}

TEST_CASE("cli: a faulty scene or rig ends with 3 and names the file") {
    const TemporaryFolder folder;
    const std::string broken = folder / "broken.gltf";
    for (const std::string_view text : {"", "{", "[]", "{}", R"({"asset": {"version": "1.0"}})"}) {
        CAPTURE(text);
        writeText(broken, text);
        CHECK(has(failing(ErrorKind::scene, {"info", broken}).err, "broken.gltf"));
        CHECK(has(failing(ErrorKind::scene, {"render", broken, "-o", folder / "a.png"}).err, "broken.gltf"));
    }
    const std::string rig = folder / "broken.json";
    writeText(rig, "{");
    CHECK(has(failing(ErrorKind::scene, {"info", "builtin:materials", "--rig", rig}).err, "broken.json"));
    CHECK(folder.count() == 2);
}

TEST_CASE("cli: files that can't be read end with 4") {
    const TemporaryFolder folder;
    CHECK(has(failing(ErrorKind::io, {"info", folder / "none.glb"}).err, "No such file"));
    CHECK(
        has(failing(ErrorKind::io, {"info", "builtin:materials", "--rig", folder / "none.json"}).err, "No such file"));
}

TEST_CASE("cli: an output that can't be written ends with 4 before the scene is even read") {
    const TemporaryFolder folder;
    writeText(folder / "file", "");
    std::filesystem::create_directory(folder / "folder.png");
    const auto renderFails = [&](const std::string& file) {
        return failing(ErrorKind::io, {"render", folder / "no scene.glb", "-o", file}).err;
    };
    CHECK(has(renderFails(folder / "none/a.png"), "none/a.png: can't write: No such file"));
    CHECK(has(renderFails(folder / "file/a.png"), "file/a.png: can't write: Not a directory"));
    CHECK(has(renderFails(folder / "folder.png"), "folder.png: can't write: Is a directory"));
    std::filesystem::create_symlink("/dev/null", folder / "null.png");
    CHECK(has(renderFails(folder / "null.png"), "null.png: can't write: not a regular file"));
    CHECK(has(renderFails(folder / (std::string(300, 'x') + ".png")), "can't write: File name too long"));
    CHECK(
        has(failing(ErrorKind::io, {"scene", folder / "no scene.glb", "-o", folder / "none/a.glb"}).err, "none/a.glb"));
}

TEST_CASE("cli: a result that can't be written to standard output ends with 4") {
    Process process({"/bin/sh", "-c", "exec \"$0\" techniques >/dev/full", LUCIOLE_BINARY});
    const Run run = process.wait();
    CHECK(run.exitCode == int(ErrorKind::io));
    CHECK(has(run.err, "standard output"));
}

TEST_CASE("cli: a standard error that is closed or full changes neither result nor exit code") {
    const TemporaryFolder folder;
    for (const std::string stream : {"2>&-", "2>/dev/full"}) {
        CAPTURE(stream);
        const auto exitCodeOf = [&](const std::string& arguments) {
            const std::string script = "exec \"$0\" " + arguments + " " + stream;
            return Process({"/bin/sh", "-c", script, LUCIOLE_BINARY, folder / "a.png"}).wait().exitCode;
        };
        CHECK(exitCodeOf("info none.glb") == int(ErrorKind::io));
        CHECK(exitCodeOf("paint") == int(ErrorKind::usage));
        CHECK(exitCodeOf("render builtin:materials -o \"$1\" --size 2x2 --lighting reference -v --stats") == 0);
        CHECK(textOf(folder / "a.png").starts_with("\x89PNG"));
    }
}

TEST_CASE("cli: a name with a terminal's commands in it is shown without them") {
    const TemporaryFolder folder;
    const std::string rig = folder / "rig.json";
    writeText(rig, R"({"cameras": [{"name": "a\u001b[31m\nb", "eye": [0, 0, 1], "target": [0, 0, 0]}]})");
    const Run run = runLuciole({"info", "builtin:materials", "--rig", rig});
    CHECK(run.exitCode == 0);
    CHECK(has(run.out, "a [31m b (perspective"));
    CHECK(has(failing(ErrorKind::io, {"info", "a\033[31m\nb.glb"}).err, "a [31m b.glb: can't read"));
}

TEST_CASE("cli: without a driver, rendering ends with 5, and all that needs none works") {
    const TemporaryFolder folder;
    failing(ErrorKind::device, {"render", "builtin:materials", "-q", "-o", folder / "a.png"}, withoutDrivers());
    CHECK(folder.count() == 0);
    CHECK(runLuciole(renderTo(folder / "a.png", {"--size", "2x2"}), withoutDrivers()).exitCode == 0);
    CHECK(folder.count() == 1);
    const Run devices = runLuciole({"devices", "--json"}, withoutDrivers());
    CHECK(devices.exitCode == 0);
    CHECK(devices.out == "[]\n");
}

TEST_CASE("cli: running out of memory ends with 6") {
#ifdef __SANITIZE_ADDRESS__
    MESSAGE("skipped: the address sanitizer reserves more address space than the test allows");
#else
    const TemporaryFolder folder;
    // 16384 x 16384 x 3 floats are 3 GiB.
    Process process(
        {"/bin/sh", "-c",
         "ulimit -v 2000000; exec \"$0\" render builtin:materials --lighting reference --size 16384x16384 -o "
         "\"$1\"",
         LUCIOLE_BINARY, folder / "a.png"});
    const Run run = process.wait();
    CHECK(run.exitCode == int(ErrorKind::deviceLost));
    CHECK(has(run.err, "luciole: error: out of memory"));
    CHECK(folder.count() == 0);
#endif
}

TEST_CASE("cli: a scene beyond a limit ends with 8") {
    const TemporaryFolder folder;
    const std::string deep = folder / "deep.gltf";
    writeText(deep,
              R"({"asset": {"version": "2.0"}, "extras": )" + std::string(1000, '[') + std::string(1000, ']') + "}");
    failing(ErrorKind::limit, {"info", deep});
}
