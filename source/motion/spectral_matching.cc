// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/simd.h>
#include <voussoir/motion/response_spectrum.h>
#include <voussoir/motion/spectral_matching.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Voussoir
{
  namespace
  {
    using Vector = std::vector<double>;

    using Four = double __attribute__((vector_size(32), aligned(8), may_alias)); ///< four independent sums

    /** Adds the products of four numbers of two vectors @p a and four vectors @p b to @p sum, up to @p size, a multiple
     * of four. Each number is read once for several products. */
    VOUSSOIR_WITH_AVX void add_products(const double *const *a, const double *const *b,
                                        const std::size_t size, Four *sum)
    {
      Four s0 = {}, s1 = {}, s2 = {}, s3 = {}, s4 = {}, s5 = {}, s6 = {}, s7 = {};
      for (std::size_t i = 0; i < size; i += 4)
      {
        const Four x = *reinterpret_cast<const Four *>(a[0] + i),
                   y = *reinterpret_cast<const Four *>(a[1] + i),
                   b0 = *reinterpret_cast<const Four *>(b[0] + i),
                   b1 = *reinterpret_cast<const Four *>(b[1] + i),
                   b2 = *reinterpret_cast<const Four *>(b[2] + i),
                   b3 = *reinterpret_cast<const Four *>(b[3] + i);
        s0 += x * b0, s1 += x * b1, s2 += x * b2, s3 += x * b3;
        s4 += y * b0, s5 += y * b1, s6 += y * b2, s7 += y * b3;
      }
      sum[0] = s0, sum[1] = s1, sum[2] = s2, sum[3] = s3, sum[4] = s4, sum[5] = s5, sum[6] = s6, sum[7] = s7;
    }

    /** Returns the product of two vectors from its sums up to the last multiple of four. */
    double product(const Four &sum, const Vector &a, const Vector &b)
    {
      double first = sum[0];
      for (std::size_t i = a.size() / 4 * 4; i < a.size(); ++i)
        first += a[i] * b[i];
      return (first + sum[1]) + (sum[2] + sum[3]);
    }

    double dot(const Vector &a, const Vector &b)
    {
      Four sum = {};
      for (std::size_t i = 0; i + 4 <= a.size(); i += 4)
        for (unsigned int j = 0; j < 4; ++j)
          sum[j] += a[i + j] * b[i + j];
      return product(sum, a, b);
    }

    /** Returns the products of all vectors with all earlier ones, each as by dot(). @p ends: numbers after which a vector
     * is zero. */
    std::vector<Vector> products_of(const std::vector<Vector> &vectors, const std::vector<std::size_t> &ends)
    {
      const std::size_t   n = vectors.size(), even = n / 2 * 2;
      std::vector<Vector> result(n, Vector(n));
      for (std::size_t i = 0; i < n; i += 2)
      {
        std::size_t j = 0;
        for (; i < even && j + 4 <= i; j += 4)
        {
          const double *a[2] = {vectors[i].data(), vectors[i + 1].data()}, *b[4];
          for (unsigned int d = 0; d < 4; ++d)
            b[d] = vectors[j + d].data();
          Four              sums[8];
          const std::size_t end =
              std::min(std::max(ends[i], ends[i + 1]), *std::max_element(&ends[j], &ends[j] + 4));
          add_products(a, b, std::min(end + 3, vectors[i].size()) / 4 * 4, sums);
          for (unsigned int d = 0; d < 8; ++d)
            result[i + d / 4][j + d % 4] = product(sums[d], vectors[i + d / 4], vectors[j + d % 4]);
        }
        for (std::size_t row = i; row < std::min(i + 2, n); ++row)
          for (std::size_t k = j; k < row; ++k)
            result[row][k] = dot(vectors[row], vectors[k]);
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
        const auto is_zero = [](const double entry) { return entry == 0.; };
        ends.push_back(std::find_if_not(gradient.rbegin(), gradient.rend(), is_zero).base() -
                       gradient.begin());
        of.push_back({gradients.size(), no_sample, value / norm, slack});
        gradients.push_back(std::move(gradient));
      }

      /** Adds the condition that the change of a sample is @p value. */
      void add_sample(const std::size_t sample, const double value, const double slack)
      {
        if (root_weight[sample] > 0.)
          of.push_back({0, sample, value / root_weight[sample], slack});
      }

      /** Returns the smallest change, in the norm weighted by 1/envelope, that satisfies the conditions. */
      Vector least_change() const
      {
        std::vector<Vector>       gram(of.size(), Vector(of.size(), 0.));
        const std::vector<Vector> products = products_of(gradients, ends);
        Vector                    values;
        for (std::size_t i = 0; i < of.size(); ++i)
        {
          for (std::size_t j = 0; j < i; ++j)
            if (of[i].sample == no_sample && of[j].sample == no_sample)
              gram[i][j] = products[of[i].gradient][of[j].gradient];
            else if (of[i].sample == no_sample)
              gram[i][j] = gradients[of[i].gradient][of[j].sample];
            else if (of[j].sample == no_sample)
              gram[i][j] = gradients[of[j].gradient][of[i].sample];
          gram[i][i] = 1. + of[i].slack;
          values.push_back(of[i].value);
        }
        const Vector multipliers = solve(std::move(gram), values);

        Vector change(root_weight.size(), 0.);
        for (std::size_t i = 0; i < of.size(); ++i)
          if (of[i].sample != no_sample)
            change[of[i].sample] += multipliers[i];
          else
            for (std::size_t k = 0; k < ends[of[i].gradient]; ++k)
              change[k] += multipliers[i] * gradients[of[i].gradient][k];
        for (std::size_t k = 0; k < change.size(); ++k)
          change[k] *= root_weight[k];
        return change;
      }

    private:
      static constexpr std::size_t no_sample = -1;
      struct Condition
      {
        std::size_t gradient, sample; ///< index in gradients; no_sample, or the only sample that is not zero
        double      value, slack;
      };
      Vector              root_weight;
      std::vector<Vector> gradients;
      std::vector<std::size_t>
          ends; ///< of the gradients: zero from there on, since later samples do not change a peak
      std::vector<Condition> of;
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
          conditions.add_sample(a - acceleration.begin(), std::copysign(peak, *a) - *a, exactly);
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
