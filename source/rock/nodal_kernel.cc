// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/rock/nodal_kernel.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define VOUSSOIR_WIDE_VECTORS
#endif

namespace Voussoir
{
  namespace
  {
    /** Returns the corner of a step; consecutive corners share an edge. */
    constexpr unsigned int corner_at(const unsigned int step)
    {
      return step ^ (step >> 1);
    }
    constexpr unsigned int step_at(const unsigned int corner)
    {
      return corner ^ (corner >> 1) ^ (corner >> 2);
    }
    constexpr unsigned int first_step(const unsigned int w)
    {
      return std::min(std::min(step_at(w), step_at(w ^ 1)), std::min(step_at(w ^ 2), step_at(w ^ 4)));
    }
    constexpr unsigned int last_step(const unsigned int w)
    {
      return std::max(std::max(step_at(w), step_at(w ^ 1)), std::max(step_at(w ^ 2), step_at(w ^ 4)));
    }
#define VOUSSOIR_INLINE __attribute__((always_inline)) inline
    // Each of the following namespaces has the functions load and add. The function load sorts the values at
    // n_wide nodes by component. The function add sorts forces by node and adds them node after node, because
    // two cells of a pack may share a node.

    namespace Plain
    {
      constexpr unsigned int n_wide = 2;
      typedef double         Lanes __attribute__((vector_size(16), may_alias));

      struct Vectors
      {
        Lanes c[3];
      };

      VOUSSOIR_INLINE void load(const double *nodes, const std::uint16_t *at, Vectors &x, Vectors &u)
      {
        const auto *p = reinterpret_cast<const Lanes *>(nodes + 2 * std::size_t(at[0])),
                   *q = reinterpret_cast<const Lanes *>(nodes + 2 * std::size_t(at[1]));
        x.c[0] = __builtin_shufflevector(p[0], q[0], 0, 2);
        x.c[1] = __builtin_shufflevector(p[0], q[0], 1, 3);
        x.c[2] = __builtin_shufflevector(p[1], q[1], 0, 2);
        u.c[0] = __builtin_shufflevector(p[2], q[2], 0, 2);
        u.c[1] = __builtin_shufflevector(p[2], q[2], 1, 3);
        u.c[2] = __builtin_shufflevector(p[3], q[3], 0, 2);
      }

      VOUSSOIR_INLINE void add(const Vectors &a, const std::uint16_t *node, double *data)
      {
        auto *p = reinterpret_cast<Lanes *>(data + node[0]);
        p[0] += __builtin_shufflevector(a.c[0], a.c[1], 0, 2);
        p[1] += a.c[2];
        auto *q = reinterpret_cast<Lanes *>(data + node[1]);
        q[0] += __builtin_shufflevector(a.c[0], a.c[1], 1, 3);
        q[1] += __builtin_shufflevector(a.c[2], a.c[2], 1, 0);
      }

#include "nodal_packs.h"
    } // namespace Plain

#ifdef VOUSSOIR_WIDE_VECTORS
#pragma GCC push_options
#pragma GCC target("avx2,fma")
    namespace Avx2
    {
      constexpr unsigned int n_wide = 4;
      typedef double         Lanes __attribute__((vector_size(32), may_alias));

      struct Vectors
      {
        Lanes c[3];
      };

      VOUSSOIR_INLINE void load_half(const double *nodes, const std::uint16_t *at, Vectors &a)
      {
        Lanes even[2], odd[2]; // components 0 and 2, and component 1, of two nodes
        for (unsigned int k = 0; k < 2; ++k)
        {
          const auto &p = *reinterpret_cast<const Lanes *>(nodes + 2 * std::size_t(at[2 * k])),
                     &q = *reinterpret_cast<const Lanes *>(nodes + 2 * std::size_t(at[2 * k + 1]));
          even[k] = __builtin_shufflevector(p, q, 0, 4, 2, 6);
          odd[k] = __builtin_shufflevector(p, q, 1, 5, 3, 7);
        }
        a.c[0] = __builtin_shufflevector(even[0], even[1], 0, 1, 4, 5);
        a.c[1] = __builtin_shufflevector(odd[0], odd[1], 0, 1, 4, 5);
        a.c[2] = __builtin_shufflevector(even[0], even[1], 2, 3, 6, 7);
      }

      VOUSSOIR_INLINE void load(const double *nodes, const std::uint16_t *at, Vectors &x, Vectors &u)
      {
        load_half(nodes, at, x);
        load_half(nodes + 4, at, u);
      }

      VOUSSOIR_INLINE void add(const Vectors &a, const std::uint16_t *node, double *data)
      {
        const auto  at = [&](const unsigned int i) { return reinterpret_cast<Lanes *>(data + node[i]); };
        const Lanes p = __builtin_shufflevector(a.c[0], a.c[1], 0, 4, 2, 6);
        const Lanes q = __builtin_shufflevector(a.c[0], a.c[1], 1, 5, 3, 7);
        *at(0) += __builtin_shufflevector(p, a.c[2], 0, 1, 4, 5);
        *at(1) += __builtin_shufflevector(q, a.c[2], 0, 1, 5, 4);
        *at(2) += __builtin_shufflevector(p, a.c[2], 2, 3, 6, 7);
        *at(3) += __builtin_shufflevector(q, a.c[2], 2, 3, 7, 6);
      }

#include "nodal_packs.h"
    } // namespace Avx2

#pragma GCC target("avx512f")
    namespace Avx512
    {
      constexpr unsigned int n_wide = 8;
      typedef double         Half __attribute__((vector_size(32), may_alias));
      typedef double         Lanes __attribute__((vector_size(64), may_alias));

      struct Vectors
      {
        Lanes c[3];
      };

      VOUSSOIR_INLINE void load(const double *nodes, const std::uint16_t *at, Vectors &x, Vectors &u)
      {
        Lanes even[4], odd[4]; // two nodes: components 0, 2 and 1 of x and u
        for (unsigned int k = 0; k < 4; ++k)
        {
          const auto &p = *reinterpret_cast<const Lanes *>(nodes + 2 * std::size_t(at[2 * k])),
                     &q = *reinterpret_cast<const Lanes *>(nodes + 2 * std::size_t(at[2 * k + 1]));
          even[k] = __builtin_shufflevector(p, q, 0, 8, 2, 10, 4, 12, 6, 14);
          odd[k] = __builtin_shufflevector(p, q, 1, 9, 3, 11, 5, 13, 7, 15);
        }
        Lanes first[2], second[2], third[2]; // components of four nodes, x and u alternating
        for (unsigned int k = 0; k < 2; ++k)
        {
          const Lanes &p = even[2 * k], &q = even[2 * k + 1];
          first[k] = __builtin_shufflevector(p, q, 0, 1, 4, 5, 8, 9, 12, 13);
          third[k] = __builtin_shufflevector(p, q, 2, 3, 6, 7, 10, 11, 14, 15);
          second[k] = __builtin_shufflevector(odd[2 * k], odd[2 * k + 1], 0, 1, 4, 5, 8, 9, 12, 13);
        }
        x.c[0] = __builtin_shufflevector(first[0], first[1], 0, 1, 4, 5, 8, 9, 12, 13);
        u.c[0] = __builtin_shufflevector(first[0], first[1], 2, 3, 6, 7, 10, 11, 14, 15);
        x.c[1] = __builtin_shufflevector(second[0], second[1], 0, 1, 4, 5, 8, 9, 12, 13);
        u.c[1] = __builtin_shufflevector(second[0], second[1], 2, 3, 6, 7, 10, 11, 14, 15);
        x.c[2] = __builtin_shufflevector(third[0], third[1], 0, 1, 4, 5, 8, 9, 12, 13);
        u.c[2] = __builtin_shufflevector(third[0], third[1], 2, 3, 6, 7, 10, 11, 14, 15);
      }

      VOUSSOIR_INLINE void add(const Vectors &a, const std::uint16_t *node, double *data)
      {
        const auto  at = [&](const unsigned int i) { return reinterpret_cast<Half *>(data + node[i]); };
        const Lanes p = __builtin_shufflevector(a.c[0], a.c[1], 0, 8, 2, 10, 4, 12, 6, 14);
        const Lanes q = __builtin_shufflevector(a.c[0], a.c[1], 1, 9, 3, 11, 5, 13, 7, 15);
        const Lanes pair[4] = {__builtin_shufflevector(p, a.c[2], 0, 1, 8, 9, 2, 3, 10, 11),
                               __builtin_shufflevector(q, a.c[2], 0, 1, 9, 8, 2, 3, 11, 10),
                               __builtin_shufflevector(p, a.c[2], 4, 5, 12, 13, 6, 7, 14, 15),
                               __builtin_shufflevector(q, a.c[2], 4, 5, 13, 12, 6, 7, 15, 14)};
        for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int i = k + (k & 2u);
          *at(i) += __builtin_shufflevector(pair[k], pair[k], 0, 1, 2, 3);
          *at(i + 2) += __builtin_shufflevector(pair[k], pair[k], 4, 5, 6, 7);
        }
      }

#include "nodal_packs.h"
    } // namespace Avx512
#pragma GCC pop_options
#endif

    struct Row
    {
      const char *name;
      NodalKernel kernel;
      bool        can_run;
    };

    /** Returns all kernels, the fastest first. */
    std::vector<Row> rows()
    {
      std::vector<Row> result;
#ifdef VOUSSOIR_WIDE_VECTORS
      const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
      result.push_back({"avx512", Avx512::multiply, avx2 && __builtin_cpu_supports("avx512f")});
      result.push_back({"avx2", Avx2::multiply, avx2});
#endif
      result.push_back({"matrix", nullptr, true});
      result.push_back({"plain", Plain::multiply, true});
      return result;
    }
  } // namespace

  std::vector<const char *> nodal_kernels()
  {
    std::vector<const char *> names;
    for (const Row &row : rows())
      if (row.can_run)
        names.push_back(row.name);
    return names;
  }

  NodalKernel nodal_kernel(const char *name)
  {
    if (name == nullptr)
      name = std::getenv("VOUSSOIR_KERNEL");
    std::string known;
    for (const Row &row : rows())
      if (row.can_run)
      {
        if (name == nullptr || std::strcmp(name, row.name) == 0)
          return row.kernel;
        known += (known.empty() ? "" : ", ") + std::string(row.name);
      }
    throw InputError("The environment variable VOUSSOIR_KERNEL is \"" + std::string(name) +
                     "\", but this processor has the kernels " + known +
                     ". Unset the variable to use the fastest kernel.");
  }
} // namespace Voussoir
