#include <doctest/doctest.h>

#include <luciole/error.hpp>
#include <luciole/settings.hpp>
#include <set>
#include <string>

using namespace luciole;

namespace {

/// Values that `setting` has to take.
std::vector<std::string> validValues(const Setting& setting) {
    if (setting.type == "choice") return setting.choices;
    if (setting.type == "switch") return {"on", "off"};
    if (setting.type == "number") return {"-64", "-1.25", "0", "64"};
    if (setting.type == "whole") return {std::to_string(int(setting.low)), std::to_string(int(setting.high))};
    return {"clustered"};
}

template <typename Action>
std::string usageError(Action action) {
    try {
        action();
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::usage);
        return error.what();
    }
    FAIL_CHECK("expected an error");
    return "";
}

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("settings: every row takes each of its values and gives it back") {
    for (const Setting& setting : settingsTable()) {
        for (const std::string& value : validValues(setting)) {
            RenderSettings settings;
            setSetting(settings, setting.name, value);
            CHECK(setting.get(settings) == value);
        }
    }
}

TEST_CASE("settings: names are different, and defaults are values that the row takes itself") {
    std::set<std::string_view> names;
    for (const Setting& setting : settingsTable()) {
        CHECK(names.insert(setting.name).second);
        CHECK_FALSE(setting.help.empty());
        RenderSettings settings;
        setSetting(settings, setting.name, setting.get(RenderSettings{}));
        CHECK(setting.get(settings) == setting.get(RenderSettings{}));
    }
}

TEST_CASE("settings: the choices stand for the values of their enum") {
    RenderSettings settings;
    setSetting(settings, "gbuffer", "calver");
    CHECK(settings.gbuffer == GBufferLayout::calver);
    setSetting(settings, "gbuffer", "float");
    CHECK(settings.gbuffer == GBufferLayout::floatPosition);
    setSetting(settings, "light-buffer", "rgba16f");
    CHECK(settings.lightBuffer == LightBufferFormat::rgba16f);
    setSetting(settings, "tonemap", "agx");
    CHECK(settings.toneMap == ToneMap::agx);
    setSetting(settings, "depth-prepass", "on");
    CHECK(settings.depthPrepass);
    setSetting(settings, "exposure", "+1.5");
    CHECK(settings.exposureEv == 1.5f);
    setSetting(settings, "lighting", "reference");
    CHECK(settings.lighting == "reference");
}

TEST_CASE("settings: a value outside a row's range is refused by name, and changes nothing") {
    for (const Setting& setting : settingsTable()) {
        for (const char* value : {"", "nan", "inf", "1e99", "65", "-65", "1x", "+-1", "AGX", "yes", " on"}) {
            if (setting.type == "name" && *value) continue;
            if (setting.type == "whole" && setting.high >= 65 && std::string_view(value) == "65") continue;
            RenderSettings settings;
            const std::string message = usageError([&] { setSetting(settings, setting.name, value); });
            CHECK(message.starts_with(std::string(setting.name) + ": expected "));
            CHECK(has(message, std::string("got \"") + value + "\""));
            CHECK(setting.get(settings) == setting.get(RenderSettings{}));
        }
    }
    RenderSettings settings;
    CHECK(has(usageError([&] { setSetting(settings, "shine", "1"); }), "unknown setting \"shine\""));
}

TEST_CASE("settings: a file sets what it names and leaves the rest") {
    RenderSettings settings;
    settings.exposureEv = 3;
    applySettingsText(settings, R"({"lighting": "clustered", "tonemap": "none", "depth-prepass": true})", "fast.json");
    CHECK(settings.lighting == "clustered");
    CHECK(settings.toneMap == ToneMap::none);
    CHECK(settings.depthPrepass);
    CHECK(settings.exposureEv == 3);
    applySettingsText(settings, R"({"exposure": -1, "depth-prepass": false})", "fast.json");
    CHECK(settings.exposureEv == -1);
    CHECK_FALSE(settings.depthPrepass);
}

TEST_CASE("settings: a faulty file is refused whole, with its name and the key") {
    const auto messageFor = [](std::string_view json) {
        RenderSettings settings;
        const std::string message = usageError([&] { applySettingsText(settings, json, "a.json"); });
        CHECK(settings.toneMap == RenderSettings{}.toneMap);
        return message;
    };
    CHECK(has(messageFor(R"({"tonemap": "agx", "zzz": 1})"), "a.json: /zzz: unknown setting"));
    CHECK(
        has(messageFor(R"({"tonemap": "warm"})"), "a.json: /tonemap: expected one of none, reinhard, aces, agx, got"));
    CHECK(has(messageFor(R"({"exposure": "1"})"), "a.json: /exposure: expected a number from -64 to 64, got \"1\""));
    CHECK(has(messageFor(R"({"measure": "on"})"), "a.json: /measure: expected on or off"));
    CHECK(has(messageFor(R"({"lighting": null})"), "a.json: /lighting: expected a name"));
    for (const char* json : {"", "{", "{\"exposure\": NaN}"})
        CHECK(has(messageFor(json), "a.json: parse error at line 1, column "));
    for (const char* json : {"[]", "1"}) CHECK(has(messageFor(json), "a.json: /: expected an object, got "));
    CHECK(has(messageFor(R"({"exposure": 1, "exposure": 2})"), "given twice"));
}

TEST_CASE("settings: a file nested deep enough to exhaust the stack is refused") {
    RenderSettings settings;
    const std::string deep = R"({"exposure": )" + std::string(1 << 20, '[') + std::string(1 << 20, ']') + "}";
    CHECK(has(usageError([&] { applySettingsText(settings, deep, "a.json"); }), "nesting of at most"));
}
