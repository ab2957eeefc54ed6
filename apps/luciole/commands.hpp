#pragma once
#include <CLI/CLI.hpp>

namespace luciole::cli {

// Each adds one subcommand, which runs while `app` parses. What it prints for programs goes to stdout, all else to
// stderr; failures leave as luciole::Error.
void addRenderCommand(CLI::App& app);
void addInfoCommand(CLI::App& app);
void addAdviseCommand(CLI::App& app);
void addSceneCommand(CLI::App& app);
void addDevicesCommand(CLI::App& app);
void addSettingsCommand(CLI::App& app);
void addTechniquesCommand(CLI::App& app);
void addBenchCommand(CLI::App& app);
void addGraphCommand(CLI::App& app);
/// \param exitCode set to 1 if the pictures differ; must outlive `app`
void addCompareCommand(CLI::App& app, int& exitCode);

}  // namespace luciole::cli
