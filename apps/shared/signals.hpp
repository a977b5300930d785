#pragma once

namespace rill::apps {

/// From now on SIGINT, SIGTERM and SIGHUP are recorded, so that the program can finish the current frame and exit; a second
/// one of a kind ends it at once. SIGHUP stays ignored where it was (nohup). SIGPIPE is ignored: write() returns EPIPE.
void installSignals();

/// The number of the first recorded signal, or 0.
int signalReceived();

}  // namespace rill::apps
