#pragma once
#include <machine.hpp>
#include <reproduce.hpp>
#include <string>
#include <vector>

#include "bench_run.hpp"

namespace luciole::cli {

/// What people read: a heading, Markdown tables and a verdict for the cell.
std::string cellText(const CellResult& result);

/// Markdown: the median of each technique in each cell; empty if there is but one cell.
std::string summaryText(const std::vector<CellResult>& results);

/// All of it for programs. docs/command-line.md says what each member is.
std::string benchJson(const bench::Machine& machine, const std::vector<CellResult>& results);

/// What somebody published beside what was measured: for people, and for programs.
std::string reproductionText(const bench::Machine& machine, const bench::Reproduction& reproduction, const std::vector<bench::Ratio>& ratios);
std::string reproductionJson(const bench::Machine& machine, const bench::Reproduction& reproduction, const std::vector<bench::Ratio>& ratios);

/// A row for each technique in each cell, machine included, under a row of names.
std::string benchCsv(const bench::Machine& machine, const std::vector<CellResult>& results);

}  // namespace luciole::cli
