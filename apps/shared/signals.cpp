#include "shared/signals.hpp"

#include <csignal>
#include <initializer_list>

namespace rill::apps {
namespace {

volatile std::sig_atomic_t g_received = 0;

extern "C" void storeSignal(int number) {
  if (g_received == 0) g_received = number;
}

}  // namespace

void installSignals() {
  struct sigaction action {};
  action.sa_handler = storeSignal;
  // RESETHAND: a second signal ends the program at once. RESTART: not all drivers handle EINTR.
  action.sa_flags = static_cast<int>(static_cast<unsigned>(SA_RESETHAND) | static_cast<unsigned>(SA_RESTART));
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    if (number == SIGHUP && sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(number, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

int signalReceived() { return g_received; }

}  // namespace rill::apps
