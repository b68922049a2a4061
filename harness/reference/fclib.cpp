#include "reference/fclib.hpp"

#include <Eigen/LU>
#include <stdexcept>

#include "reference/hdf5_file.hpp"

namespace plumb::reference {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int by_columns = -1, by_rows = -2;  // FCLIB's nz; else the number of triplets

std::size_t as_size(int value) { return static_cast<std::size_t>(value); }

/// One of FCLIB's sparse matrices, as a dense one.
class MatrixReader {
 public:
  MatrixReader(const Hdf5File& file, const std::string& path) : file_(file), path_(path) {
    if (!file.has(path)) file.fail("group " + path + " is missing");
    m_ = file.integer(path + "/m");
    n_ = file.integer(path + "/n");
    nz_ = file.integer(path + "/nz");
    if (m_ < 0 || n_ < 0 || m_ > 3 * most_contacts || n_ > 3 * most_contacts)
      file.fail(path + " is of " + std::to_string(m_) + " rows and " + std::to_string(n_) +
                " columns; this solver takes at most " + std::to_string(most_contacts) + " contacts");
    p_ = file.integers(path + "/p");
    i_ = file.integers(path + "/i");
    x_ = file.numbers(path + "/x");
  }

  [[nodiscard]] MatrixXd dense() const {
    MatrixXd matrix = MatrixXd::Zero(m_, n_);
    if (nz_ >= 0) {
      need(p_.size(), nz_, "p");
      need(i_.size(), nz_, "i");
      need(x_.size(), nz_, "x");
      for (std::size_t k = 0; k < as_size(nz_); ++k) add(matrix, p_[k], i_[k], x_[k]);
      return matrix;
    }
    if (nz_ != by_columns && nz_ != by_rows)
      file_.fail(path_ + "/nz is " + std::to_string(nz_) + ": known are -1 (by columns), -2 (by rows), and counts");
    const bool rows = nz_ == by_rows;
    const int lines = rows ? m_ : n_;
    need(p_.size(), lines + 1, "p");
    if (p_[0] != 0) file_.fail(path_ + "/p does not begin with 0");
    for (std::size_t line = 0; line < as_size(lines); ++line)
      if (p_[line + 1] < p_[line]) file_.fail(path_ + "/p decreases at " + std::to_string(line + 1));
    need(i_.size(), p_[as_size(lines)], "i");
    need(x_.size(), p_[as_size(lines)], "x");
    for (int line = 0; line < lines; ++line)
      for (auto k = as_size(p_[as_size(line)]); k < as_size(p_[as_size(line) + 1]); ++k)
        add(matrix, rows ? line : i_[k], rows ? i_[k] : line, x_[k]);
    return matrix;
  }

 private:
  void need(std::size_t size, int least, const char* name) const {
    if (size < as_size(least))
      file_.fail(path_ + "/" + name + " holds " + std::to_string(size) + " numbers, but m, n, nz and p ask for " +
                 std::to_string(least));
  }
  void add(MatrixXd& matrix, int row, int column, double value) const {
    if (row < 0 || row >= m_ || column < 0 || column >= n_)
      file_.fail(path_ + " has an entry at row " + std::to_string(row) + ", column " + std::to_string(column) +
                 ", but is of " + std::to_string(m_) + " rows and " + std::to_string(n_) + " columns");
    matrix(row, column) += value;
  }

  const Hdf5File& file_;
  std::string path_;
  int m_ = 0, n_ = 0, nz_ = 0;
  std::vector<int> p_, i_;
  std::vector<double> x_;
};

VectorXd vector_at(const Hdf5File& file, const std::string& path, Index size) {
  const std::vector<double> values = file.numbers(path);
  if (static_cast<Index>(values.size()) != size)
    file.fail(path + " holds " + std::to_string(values.size()) + " numbers, but the matrices ask for " +
              std::to_string(size));
  return Eigen::Map<const VectorXd>(values.data(), size);
}

/// Equations V' r + R l + s = 0 solved for l.
void eliminate_equations(const Hdf5File& file, MatrixXd& w, VectorXd& q) {
  const MatrixXd v = MatrixReader(file, "/fclib_local/V").dense(), r = MatrixReader(file, "/fclib_local/R").dense();
  if (v.rows() != w.rows() || r.rows() != v.cols() || r.cols() != v.cols())
    file.fail("/fclib_local/V and R do not fit W and each other");
  const VectorXd s = vector_at(file, "/fclib_local/vectors/s", r.rows());
  const Eigen::FullPivLU<MatrixXd> factors(r);
  if (!factors.isInvertible()) file.fail("/fclib_local/R is singular: its equations have no unique solution");
  w -= v * factors.solve(v.transpose());
  q -= v * factors.solve(s);
}

/// Two rows a contact to three: the new tangent's mobility is that of the normal, and no impulse acts along it.
ContactProblem in_space(const MatrixXd& w, const VectorXd& q, const VectorXd& mu) {
  ContactProblem problem{MatrixXd::Zero(3 * mu.size(), 3 * mu.size()), VectorXd::Zero(3 * mu.size()), mu};
  for (Index a = 0; a < mu.size(); ++a) {
    for (Index b = 0; b < mu.size(); ++b) problem.w.block<2, 2>(3 * a, 3 * b) = w.block<2, 2>(2 * a, 2 * b);
    problem.w(3 * a + 2, 3 * a + 2) = w(2 * a, 2 * a);
    problem.q.segment<2>(3 * a) = q.segment<2>(2 * a);
  }
  return problem;
}

std::vector<double> numbers_of(const VectorXd& v) { return {v.data(), v.data() + v.size()}; }

}  // namespace

FclibProblem read_fclib(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::open(path);
  if (!file.has("/fclib_local"))
    file.fail(file.has("/fclib_global") ? "it holds a global problem (/fclib_global), and only local ones are solved"
                                        : "group /fclib_local is missing: this is no problem of FCLIB's");
  FclibProblem result;
  result.spacedim = file.integer("/fclib_local/spacedim");
  if (result.spacedim != 2 && result.spacedim != 3)
    file.fail("/fclib_local/spacedim is " + std::to_string(result.spacedim) + ", not 2 or 3");
  MatrixXd w = MatrixReader(file, "/fclib_local/W").dense();
  if (w.rows() != w.cols() || w.rows() % result.spacedim != 0)
    file.fail("/fclib_local/W is of " + std::to_string(w.rows()) + " rows and " + std::to_string(w.cols()) +
              " columns, not of as many, a multiple of " + std::to_string(result.spacedim));
  VectorXd q = vector_at(file, "/fclib_local/vectors/q", w.rows());
  const VectorXd mu = vector_at(file, "/fclib_local/vectors/mu", w.rows() / result.spacedim);
  if (file.has("/fclib_local/V") || file.has("/fclib_local/R")) eliminate_equations(file, w, q);
  result.problem = result.spacedim == 3 ? ContactProblem{std::move(w), std::move(q), mu} : in_space(w, q, mu);
  try {
    result.problem.check();
  } catch (const std::invalid_argument& error) {
    file.fail(error.what());
  }
  result.title = file.text("/fclib_local/info/title");
  result.description = file.text("/fclib_local/info/description");
  result.math_info = file.text("/fclib_local/info/math_info");
  if (result.spacedim == 3 && file.has("/solution/r"))
    result.impulse = vector_at(file, "/solution/r", result.problem.q.size());
  return result;
}

std::string fclib_bytes(const FclibProblem& given) {
  const ContactProblem& problem = given.problem;
  const auto size = static_cast<int>(problem.q.size());
  Hdf5File file = Hdf5File::in_memory();
  file.put("/fclib_local/spacedim", 3);
  std::vector<int> starts{0}, rows;
  std::vector<double> values;
  for (Index column = 0; column < size; ++column) {
    for (Index row = 0; row < size; ++row) {
      if (problem.w(row, column) == 0) continue;
      rows.push_back(static_cast<int>(row));
      values.push_back(problem.w(row, column));
    }
    starts.push_back(static_cast<int>(rows.size()));
  }
  file.put("/fclib_local/W/m", size);
  file.put("/fclib_local/W/n", size);
  file.put("/fclib_local/W/nz", by_columns);
  file.put("/fclib_local/W/nzmax", static_cast<int>(values.size()));
  file.put("/fclib_local/W/p", starts);
  file.put("/fclib_local/W/i", rows);
  file.put("/fclib_local/W/x", values);
  file.put("/fclib_local/vectors/q", numbers_of(problem.q));
  file.put("/fclib_local/vectors/mu", numbers_of(problem.mu));
  file.put("/fclib_local/info/title", given.title);
  file.put("/fclib_local/info/description", given.description);
  file.put("/fclib_local/info/math_info", given.math_info);
  if (given.impulse) {
    file.put("/solution/u", numbers_of(problem.velocity(*given.impulse)));
    file.put("/solution/r", numbers_of(*given.impulse));
  }
  return file.bytes();
}

}  // namespace plumb::reference
