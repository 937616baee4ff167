#include "end_signals.h"

namespace espalier::app {

EndSignals::EndSignals(void (*handler)(int), bool only_once) {
    struct sigaction action = {};
    action.sa_handler = handler;
    for (std::size_t i = 0; i < signals_.size(); ++i) {
        const bool hang_up = signals_[i] == SIGHUP;
        action.sa_flags = only_once && !hang_up ? SA_RESETHAND | SA_RESTART : SA_RESTART;
        sigaction(signals_[i], &action, &before_[i]);
        if (hang_up && before_[i].sa_handler == SIG_IGN) sigaction(SIGHUP, &before_[i], nullptr);
    }
}

EndSignals::~EndSignals() {
    for (std::size_t i = 0; i < signals_.size(); ++i) sigaction(signals_[i], &before_[i], nullptr);
}

}  // namespace espalier::app
