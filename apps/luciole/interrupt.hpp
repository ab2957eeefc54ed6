#pragma once

namespace luciole::cli {

/// From here on Ctrl-C (and SIGTERM) ends the process at once with exit code 128 + signal: 130 for Ctrl-C.
void exitOnInterrupt();

/// While one lives, an interrupt waits for its end, so that no temporary file stays behind. A second one does not wait.
class FinishFirst {
public:
    FinishFirst();
    FinishFirst(const FinishFirst&) = delete;
    FinishFirst& operator=(const FinishFirst&) = delete;
    ~FinishFirst();
};

}  // namespace luciole::cli
