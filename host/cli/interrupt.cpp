#include "cli/interrupt.h"

#include <csignal>

namespace vndf::cli {
namespace {

volatile std::sig_atomic_t asked_ = 0;
void (*volatile next_)(int) = SIG_DFL;

extern "C" void note_interrupt(int number) {
    asked_ = 1;
    std::signal(number, next_);
}

}  // namespace

Interrupt::Interrupt() {
    asked_ = 0;
    before_ = std::signal(SIGINT, SIG_IGN);
    next_ = before_;
    if (before_ != SIG_IGN) std::signal(SIGINT, note_interrupt);
}

Interrupt::~Interrupt() {
    std::signal(SIGINT, before_);
}

bool Interrupt::asked() const {
    return asked_ != 0;
}

}  // namespace vndf::cli
