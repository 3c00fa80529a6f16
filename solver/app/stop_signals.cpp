#include "solver/app/stop_signals.hpp"

#include <csignal>

namespace snug::app {

namespace {

volatile std::sig_atomic_t first_signal = 0;

int meaning(int signal) { return signal == SIGUSR1 ? SIGINT : signal == SIGUSR2 ? SIGTERM : signal; }

extern "C" void note_signal(int signal) {
  if (first_signal == 0) {
    first_signal = meaning(signal);
    return;
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void on(int signal, void (*handler)(int)) {
  struct sigaction before {}, action {};
  ::sigaction(signal, nullptr, &before);
  if (before.sa_handler == SIG_IGN) return;  // nohup, or a shell's background
  action.sa_handler = handler;
  ::sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

StopSignals::StopSignals(bool rank) {
  first_signal = 0;
  take(rank);
}

void StopSignals::take(bool rank) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) on(signal, note_signal);
  if (rank)
    for (const int signal : {SIGUSR1, SIGUSR2}) on(signal, note_signal);
  std::signal(SIGPIPE, SIG_IGN);
}

StopSignals::~StopSignals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2}) {
    struct sigaction now {};
    ::sigaction(signal, nullptr, &now);
    if (now.sa_handler == note_signal) std::signal(signal, SIG_DFL);
  }
  std::signal(SIGPIPE, SIG_DFL);
}

int StopSignals::received() { return first_signal; }
std::string StopSignals::name(int signal) { return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "SIGHUP"; }

}  // namespace snug::app
