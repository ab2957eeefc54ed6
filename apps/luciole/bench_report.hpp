#pragma once
#include <machine.hpp>
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

/// A row for each technique in each cell, machine included, under a row of names.
std::string benchCsv(const bench::Machine& machine, const std::vector<CellResult>& results);

}  // namespace luciole::cli
