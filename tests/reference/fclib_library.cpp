#include "fclib_library.hpp"

#include <memory>
#include <stdexcept>
#include <vector>

extern "C" {
#include <fclib.h>
}

namespace plumb::reference::testing {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd dense(const fclib_matrix* matrix) {
  if (matrix == nullptr) return {};
  MatrixXd result = MatrixXd::Zero(matrix->m, matrix->n);
  if (matrix->nz >= 0) {
    for (int k = 0; k < matrix->nz; ++k) result(matrix->p[k], matrix->i[k]) += matrix->x[k];
    return result;
  }
  const bool rows = matrix->nz == -2;
  for (int line = 0; line < (rows ? matrix->m : matrix->n); ++line)
    for (int k = matrix->p[line]; k < matrix->p[line + 1]; ++k)
      (rows ? result(line, matrix->i[k]) : result(matrix->i[k], line)) += matrix->x[k];
  return result;
}

VectorXd copied(const double* values, Index size) {
  return values == nullptr ? VectorXd() : VectorXd(Eigen::Map<const VectorXd>(values, size));
}

std::string text(const char* words) { return words == nullptr ? "" : words; }

/// One of FCLIB's matrices, with the arrays that it points to.
class SparseMatrix {
 public:
  SparseMatrix(const MatrixXd& values, Layout layout) {
    const bool columns = layout == Layout::columns;
    const Index lines = columns ? values.cols() : values.rows(), across = columns ? values.rows() : values.cols();
    for (Index line = 0; line < lines; ++line) {
      if (layout != Layout::triplets) p_.push_back(static_cast<int>(x_.size()));
      for (Index k = 0; k < across; ++k) {
        const double value = columns ? values(k, line) : values(line, k);
        if (value == 0) continue;
        if (layout == Layout::triplets) p_.push_back(static_cast<int>(line));
        i_.push_back(static_cast<int>(k));
        x_.push_back(value);
      }
    }
    const int count = static_cast<int>(x_.size());
    if (layout != Layout::triplets) p_.push_back(count);
    matrix_ = {count,
               static_cast<int>(values.rows()),
               static_cast<int>(values.cols()),
               p_.data(),
               i_.data(),
               x_.data(),
               layout == Layout::triplets ? count
               : columns                  ? -1
                                          : -2,
               nullptr};
  }
  fclib_matrix* get() { return &matrix_; }

 private:
  std::vector<int> p_, i_;
  std::vector<double> x_;
  fclib_matrix matrix_{};
};

}  // namespace

ReadFile read_by_fclib(const std::filesystem::path& file, bool with_solution) {
  const auto delete_local = [](fclib_local* local) {
    fclib_delete_local(local);
    free(local);
  };
  const std::unique_ptr<fclib_local, decltype(delete_local)> local(fclib_read_local(file.c_str()), delete_local);
  if (local == nullptr) throw std::runtime_error(file.string() + ": FCLIB reads no local problem");
  ReadFile read;
  LocalProblem& problem = read.problem;
  problem.spacedim = local->spacedim;
  problem.w = dense(local->W);
  problem.v = dense(local->V);
  problem.r = dense(local->R);
  const Index rows = problem.w.rows();
  problem.q = copied(local->q, rows);
  problem.mu = copied(local->mu, rows / local->spacedim);
  problem.s = copied(local->s, problem.r.rows());
  if (local->info != nullptr) {
    problem.title = text(local->info->title);
    problem.description = text(local->info->description);
    problem.math_info = text(local->info->math_info);
  }
  if (!with_solution) return read;
  const auto delete_solution = [](fclib_solution* solution) { fclib_delete_solutions(solution, 1); };
  const std::unique_ptr<fclib_solution, decltype(delete_solution)> solution(fclib_read_solution(file.c_str()),
                                                                            delete_solution);
  if (solution == nullptr) return read;
  read.impulse = copied(solution->r, rows);
  read.velocity = copied(solution->u, rows);
  read.merit = fclib_merit_local(local.get(), MERIT_1, solution.get());
  return read;
}

void write_by_fclib(const LocalProblem& problem, Layout layout, const std::filesystem::path& file) {
  std::filesystem::remove(file);
  LocalProblem given = problem;
  SparseMatrix w(given.w, layout), v(given.v, layout), r(given.r, layout);
  fclib_info info{given.title.data(), given.description.data(), given.math_info.data()};
  const bool equations = given.r.size() > 0;
  fclib_local local{};
  local.W = w.get();
  local.V = equations ? v.get() : nullptr;
  local.R = equations ? r.get() : nullptr;
  local.mu = given.mu.data();
  local.q = given.q.data();
  local.s = equations ? given.s.data() : nullptr;
  local.spacedim = given.spacedim;
  local.info = &info;
  if (fclib_write_local(&local, file.c_str()) == 0)
    throw std::runtime_error(file.string() + ": FCLIB cannot write the problem");
}

}  // namespace plumb::reference::testing
