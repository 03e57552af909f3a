// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/motion/response_spectrum.h>
#include <voussoir/motion/spectral_matching.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace Voussoir
{
  namespace
  {
    using Vector = std::vector<double>;

    double dot(const Vector &a, const Vector &b)
    {
      // Four independent sums, for speed.
      double            sum[4] = {0., 0., 0., 0.};
      const std::size_t n = a.size() / 4 * 4;
      for (std::size_t i = 0; i < n; i += 4)
        for (unsigned int j = 0; j < 4; ++j)
          sum[j] += a[i + j] * b[i + j];
      for (std::size_t i = n; i < a.size(); ++i)
        sum[0] += a[i] * b[i];
      return (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }

    /** Returns dot() of @p a and each of four vectors, bitwise identical to dot(). The values of @p a are
     * read only once. */
    std::array<double, 4> dots(const Vector &a, const Vector *b)
    {
      double            sum[4][4] = {};
      const std::size_t n = a.size() / 4 * 4;
      for (std::size_t i = 0; i < n; i += 4)
        for (unsigned int d = 0; d < 4; ++d)
          for (unsigned int j = 0; j < 4; ++j)
            sum[d][j] += a[i + j] * b[d][i + j];
      std::array<double, 4> result;
      for (unsigned int d = 0; d < 4; ++d)
      {
        for (std::size_t i = n; i < a.size(); ++i)
          sum[d][0] += a[i] * b[d][i];
        result[d] = (sum[d][0] + sum[d][1]) + (sum[d][2] + sum[d][3]);
      }
      return result;
    }

    /** Solves A x = b by Cholesky's method. A is symmetric positive (semi)definite with a diagonal near one.
     * Only its lower triangle is used. */
    Vector solve(std::vector<Vector> A, Vector b)
    {
      const std::size_t n = b.size();
      for (std::size_t i = 0; i < n; ++i)
      {
        for (std::size_t j = 0; j <= i; ++j)
        {
          double sum = A[i][j];
          for (std::size_t k = 0; k < j; ++k)
            sum -= A[i][k] * A[j][k];
          A[i][j] = (i == j) ? std::sqrt(std::max(sum, 1e-15)) : sum / A[j][j];
        }
        for (std::size_t k = 0; k < i; ++k)
          b[i] -= A[i][k] * b[k];
        b[i] /= A[i][i];
      }
      for (std::size_t i = n; i-- > 0;)
      {
        for (std::size_t k = i + 1; k < n; ++k)
          b[i] -= A[k][i] * b[k];
        b[i] /= A[i][i];
      }
      return b;
    }

    /** Linear conditions on the change of a record: gradient . change = value, within a slack. */
    class Conditions
    {
    public:
      Conditions(const Vector &envelope)
      {
        for (const double value : envelope)
          root_weight.push_back(std::sqrt(value));
      }

      /** Adds a condition. @p slack: relative to the diagonal entry of the condition. It keeps similar
       * conditions compatible. */
      void add(Vector gradient, double value, double slack)
      {
        for (std::size_t k = 0; k < gradient.size(); ++k)
          gradient[k] *= root_weight[k];
        const double norm = std::sqrt(dot(gradient, gradient));
        if (norm == 0.)
          return;
        for (double &entry : gradient)
          entry /= norm;
        gradients.push_back(std::move(gradient));
        values.push_back(value / norm);
        slacks.push_back(slack);
      }

      /** Returns the smallest change, in the norm weighted by 1/envelope, that satisfies the conditions. */
      Vector least_change() const
      {
        std::vector<Vector> gram(gradients.size(), Vector(gradients.size()));
        for (std::size_t i = 0; i < gradients.size(); ++i)
        {
          std::size_t j = 0;
          for (; j + 4 <= i; j += 4)
          {
            const std::array<double, 4> four = dots(gradients[i], &gradients[j]);
            std::copy(four.begin(), four.end(), gram[i].begin() + j);
          }
          for (; j < i; ++j)
            gram[i][j] = dot(gradients[i], gradients[j]);
          gram[i][i] = 1. + slacks[i];
        }
        const Vector multipliers = solve(std::move(gram), values);

        Vector change(root_weight.size(), 0.);
        for (std::size_t i = 0; i < gradients.size(); ++i)
          for (std::size_t k = 0; k < change.size(); ++k)
            change[k] += multipliers[i] * gradients[i][k];
        for (std::size_t k = 0; k < change.size(); ++k)
          change[k] *= root_weight[k];
        return change;
      }

    private:
      Vector              root_weight;
      std::vector<Vector> gradients;
      Vector              values, slacks;
    };

    constexpr double exactly = 1e-12; // slack of conditions that must hold

    /** Adds the conditions that the end velocity and the end displacement are zero. Both are integrals of the
     * piecewise linear record. */
    void add_baseline(Conditions &conditions, const Vector &acceleration)
    {
      const std::size_t last = acceleration.size() - 1;
      Vector            velocity(last + 1, 1.), displacement(last + 1); // in units of dt and dt^2
      for (std::size_t k = 0; k <= last; ++k)
        displacement[k] = last - k;
      velocity[0] = velocity[last] = 0.5;
      displacement[0] = last / 2. - 1. / 6.;
      displacement[last] = 1. / 6.;
      const double end_velocity = dot(velocity, acceleration);
      const double end_displacement = dot(displacement, acceleration);
      conditions.add(std::move(velocity), -end_velocity, exactly);
      conditions.add(std::move(displacement), -end_displacement, exactly);
    }

    /** Adds the conditions that the largest sample, and all others above @p peak, become the peak. */
    void add_peak(Conditions &conditions, const Vector &acceleration, double peak)
    {
      const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
      const auto largest = std::max_element(acceleration.begin(), acceleration.end(), smaller);
      for (auto a = acceleration.begin(); a != acceleration.end(); ++a)
        if (a == largest || std::abs(*a) > peak)
        {
          Vector gradient(acceleration.size(), 0.);
          gradient[a - acceleration.begin()] = 1.;
          conditions.add(std::move(gradient), std::copysign(peak, *a) - *a, exactly);
        }
    }

    void add_change(Vector &acceleration, const Vector &change)
    {
      for (std::size_t k = 0; k < acceleration.size(); ++k)
        acceleration[k] += change[k];
    }

    /** Corrects baseline and peak exactly. The passes are repeated because the reduction of one sample may
     * raise another above the peak. */
    void finish(Vector &acceleration, const Vector &envelope, double peak)
    {
      for (unsigned int pass = 0; pass < 8; ++pass)
      {
        Conditions conditions(envelope);
        add_baseline(conditions, acceleration);
        add_peak(conditions, acceleration, peak);
        add_change(acceleration, conditions.least_change());
      }
    }

    using Peaks = std::vector<Oscillator::Peak>;

    /** Returns the peaks of the oscillators of all periods. */
    Peaks peaks_of(const Vector &acceleration, const double dt, const SpectralTarget &target)
    {
      std::vector<Oscillator> oscillators;
      for (const double period : target.periods)
        oscillators.emplace_back(period, target.damping, dt);
      return Oscillator::peaks(oscillators, acceleration);
    }

    /** Adds the condition for each oscillator that its response reaches the target. Programs that evaluate
     * the samples only obtain smaller peaks at short periods. The mean of this peak and of the true peak is
     * therefore set to the target. */
    void add_spectrum(Conditions &conditions, const Peaks &peak, const std::size_t n_samples, const double dt,
                      const SpectralTarget &target)
    {
      constexpr double slack = 0.01; // adjacent periods with peaks at different times are incompatible
      for (std::size_t i = 0; i < peak.size(); ++i)
      {
        const Oscillator oscillator(target.periods[i], target.damping, dt);
        const double     seen = 0.5 * (std::abs(peak[i].value) + peak[i].sampled);
        conditions.add(oscillator.sensitivity(peak[i].substep, n_samples),
                       std::copysign(1., peak[i].value) * (target.pseudo_acceleration[i] - seen), slack);
      }
    }

    SpectralError error_of(const Peaks &peak, const SpectralTarget &target)
    {
      SpectralError error;
      for (std::size_t i = 0; i < peak.size(); ++i)
      {
        const double aim = target.pseudo_acceleration[i];
        const double relative = std::max(std::abs(peak[i].value) - aim, aim - peak[i].sampled) / aim;
        error.maximum = std::max(error.maximum, relative);
        error.mean += relative / peak.size();
      }
      return error;
    }
  } // namespace

  SpectralError spectral_error(const Vector &acceleration, double dt, const SpectralTarget &target)
  {
    return error_of(peaks_of(acceleration, dt, target), target);
  }

  Vector match_spectrum(Vector acceleration, double dt, const Vector &envelope, const SpectralTarget &target,
                        double tolerance, unsigned int n_passes)
  {
    Vector best;
    double least_error = std::numeric_limits<double>::max();
    for (unsigned int pass = 0; pass <= n_passes; ++pass)
    {
      finish(acceleration, envelope, target.peak_acceleration);
      const Peaks  peaks = peaks_of(acceleration, dt, target);
      const double error = error_of(peaks, target).maximum;
      if (error < least_error)
      {
        least_error = error;
        best = acceleration;
      }
      if (error < tolerance || pass == n_passes)
        break;

      Conditions conditions(envelope);
      add_baseline(conditions, acceleration);
      add_peak(conditions, acceleration, target.peak_acceleration);
      add_spectrum(conditions, peaks, acceleration.size(), dt, target);
      add_change(acceleration, conditions.least_change());
    }
    return best;
  }
} // namespace Voussoir
