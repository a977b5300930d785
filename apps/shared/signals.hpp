#pragma once

namespace rill::apps {

/// SIGINT, SIGTERM and SIGHUP are noted from now on, for the program to end at a good place; the second of a kind ends it at once.
/// A hang-up that was already ignored (nohup) stays so. SIGPIPE is ignored: writing to a closed pipe is an error like others.
void installSignals();

/// The first signal that was noted, or 0.
int signalReceived();

}  // namespace rill::apps
