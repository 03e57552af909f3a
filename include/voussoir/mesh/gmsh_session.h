// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_gmsh_session_h
#define voussoir_gmsh_session_h

#include <voussoir/base/error.h>

#include <gmsh.h>

#include <new>
#include <stdexcept>
#include <string>

namespace Voussoir
{
  /** Numbers of element types in gmsh. */
  namespace GmshType
  {
    constexpr int quadrangle_4 = 3, hexahedron_8 = 5;
  }

  /** Scope in which the global state of gmsh is initialized: without output to the terminal, and without the
   * configuration files of the user. */
  class GmshSession
  {
  public:
    GmshSession()
    {
      gmsh::initialize(0, nullptr, false);
      gmsh::option::setNumber("General.Terminal", 0);
      gmsh::option::setNumber("General.AbortOnError", 3); // throw
    }
    ~GmshSession() { gmsh::finalize(); }
    GmshSession(const GmshSession &) = delete;
    GmshSession &operator=(const GmshSession &) = delete;
  };

  /** Runs @p action in a GmshSession. Errors of gmsh (strings, numbers, exceptions) become an InputError.
   *
   * @param file name of the mesh file, for the message
   * @param problem text of the message, as "gmsh cannot read this file"
   * @param action function that calls gmsh
   *
   * InputError and std::bad_alloc are passed on. std::length_error becomes std::bad_alloc. */
  template <typename Action>
  void with_gmsh(const std::string &file, const std::string &problem, const Action &action)
  {
    const GmshSession session;
    std::string       reason;
    try
    {
      action();
      return;
    }
    catch (const InputError &)
    {
      throw;
    }
    catch (const std::bad_alloc &)
    {
      throw;
    }
    catch (const std::length_error &) // requested size exceeds every memory
    {
      throw std::bad_alloc();
    }
    catch (const std::exception &error)
    {
      reason = error.what();
    }
    catch (const std::string &error)
    {
      reason = error;
    }
    catch (...)
    {
      gmsh::logger::getLastError(reason);
    }
    throw InputError("mesh " + file + ": " + problem + (reason.empty() ? "" : " (gmsh: " + reason + ")") +
                     ".");
  }
} // namespace Voussoir

#endif
