#include "shared/signals.hpp"

#include <csignal>
#include <initializer_list>

namespace rill::apps {
namespace {

volatile std::sig_atomic_t g_received = 0;

extern "C" void noteSignal(int number) {
  if (g_received == 0) g_received = number;
}

}  // namespace

void installSignals() {
  struct sigaction note {};
  note.sa_handler = noteSignal;
  // RESETHAND: the second one ends the program at once. RESTART: drivers' own system calls are not all written for EINTR.
  note.sa_flags = static_cast<int>(static_cast<unsigned>(SA_RESETHAND) | static_cast<unsigned>(SA_RESTART));
  sigemptyset(&note.sa_mask);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    if (number == SIGHUP && sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(number, &note, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

int signalReceived() { return g_received; }

}  // namespace rill::apps
