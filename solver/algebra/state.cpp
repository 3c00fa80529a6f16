#include "solver/algebra/state.hpp"

namespace snug::solver {

void each(ByteWriter& writer, const State& state) {
  writer(state.values), writer(state.load), writer(state.release), writer(state.stiffening), writer(state.yielding), writer(state.posture);
  writer(static_cast<std::uint64_t>(state.history.list().size()));
  for (const auto& [name, history] : state.history.list()) {
    ByteWriter own;
    history->write(own);
    writer(name), writer(own.bytes);
  }
}

void each(ByteReader& reader, State& state) {
  reader(state.values), reader(state.load), reader(state.release), reader(state.stiffening), reader(state.yielding), reader(state.posture);
  std::uint64_t count = 0;
  reader(count);
  state.history = {};
  for (std::uint64_t i = 0; i < count; ++i) {
    std::string name, bytes;
    reader(name), reader(bytes);
    state.history.put(name, std::make_shared<StoredHistory>(std::move(bytes)));
  }
}

}  // namespace snug::solver
