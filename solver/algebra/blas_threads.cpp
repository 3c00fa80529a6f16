#include "solver/algebra/blas_threads.hpp"

#include <dlfcn.h>

namespace snug::solver {

namespace {

int blas_threads() {
  using GetThreads = int (*)();
  const auto get = reinterpret_cast<GetThreads>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  return get ? get() : 1;
}

}  // namespace

void set_blas_threads(int threads) {
  using SetThreads = void (*)(int);
  if (const auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) set(threads);
}

OneBlasThread::OneBlasThread() : before_(blas_threads()) {
  if (before_ != 1) set_blas_threads(1);
}
OneBlasThread::~OneBlasThread() {
  if (before_ != 1) set_blas_threads(before_);
}

}  // namespace snug::solver
