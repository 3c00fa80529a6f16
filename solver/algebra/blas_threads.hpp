// How many threads BLAS takes inside this process.
#pragma once

namespace snug::solver {

/// Of OpenBLAS; another BLAS is left as it is.
void set_blas_threads(int threads);

/// One thread while it lives: on the small blocks of a low-rank factor two cost more than they bring, and beside other programs
/// they wait for each other most of the time.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;

 private:
  int before_;
};

}  // namespace snug::solver
