#include "interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace luciole::cli {
namespace {

std::atomic<bool> finishFirst = false;
std::atomic<int> pendingSignal = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free, "used in a handler");

void onSignal(int signal) {
    if (finishFirst && pendingSignal.exchange(signal) == 0) return;
    ::_exit(128 + signal);
}

}  // namespace

void exitOnInterrupt() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        // A parent that ignores a signal (nohup, a shell's background job) means it for us too.
        if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
        action = {};
        action.sa_handler = onSignal;
        ::sigaction(signal, &action, nullptr);
    }
    // Beyond the file size limit (ulimit -f) a write then fails, and what stands there is tidied up.
    std::signal(SIGXFSZ, SIG_IGN);
}

FinishFirst::FinishFirst() { finishFirst = true; }

FinishFirst::~FinishFirst() {
    finishFirst = false;
    if (const int signal = pendingSignal) ::_exit(128 + signal);
}

}  // namespace luciole::cli
