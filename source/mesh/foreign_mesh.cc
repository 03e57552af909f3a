// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/interrupt.h>
#include <voussoir/base/output_file.h>
#include <voussoir/base/python_script.h>
#include <voussoir/mesh/foreign_mesh.h>
#include <voussoir/mesh/gmsh_io.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

namespace Voussoir
{
  namespace fs = std::filesystem;

  namespace
  {
    /** Temporary directory. The destructor removes it. */
    class Scratch
    {
    public:
      Scratch()
      {
        std::error_code error;
        const fs::path  place = fs::temp_directory_path(error);
        std::string     name = (place / "voussoir-XXXXXX").string();
        if (error || mkdtemp(name.data()) == nullptr)
          throw WriteError("The temporary directory for the conversion of a mesh cannot be created " +
                           (error ? std::string("in the directory TMPDIR") : "in " + place.string()) +
                           ". Free disk space there, or set TMPDIR to another directory.");
        path = name;
      }
      ~Scratch()
      {
        std::error_code ignored;
        fs::remove_all(path, ignored);
      }
      Scratch(const Scratch &) = delete;
      Scratch &operator=(const Scratch &) = delete;

      fs::path path;
    };

    constexpr int lacks_meshio = 3; ///< exit status of the script

    std::string last_line(const std::string &file)
    {
      std::ifstream in(file);
      std::string   last = "not given.";
      for (std::string line; std::getline(in, line);)
        if (line.find_first_not_of(" \t\r") != std::string::npos)
          last = line;
      return last;
    }

    std::string replaced(std::string text, const std::string &from, const std::string &to)
    {
      for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
      return text;
    }
  } // namespace

  bool is_foreign_mesh(const std::string &file)
  {
    std::string ending = fs::path(file).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](const unsigned char c) { return std::tolower(c); });
    return ending == ".inp" || ending == ".med";
  }

  HexMesh read_foreign_mesh(const std::string &file, const bool subdivided)
  {
    std::error_code error;
    if (!fs::is_regular_file(file, error))
      throw InputError("mesh " + file +
                       ": the file does not exist or cannot be read. Check the entry "
                       "\"Mesh/File\". The path is relative to the directory of the input file.");
    const fs::path script = find_script("mesh_to_msh.py");
    if (script.empty())
      throw InputError(
          "mesh " + file +
          ": the script mesh_to_msh.py, which converts it, was not found. Set the environment variable "
          "VOUSSOIR_SCRIPTS to its directory, or convert the mesh to MSH 4.1 yourself.");
    std::optional<InterruptGuard> guard; // not only in a run: remove the files after a signal
    if (!InterruptGuard::lives())
      guard.emplace();
    const Scratch     scratch;
    const std::string made = (scratch.path / "mesh.msh").string(), said = (scratch.path / "log").string();
    int               status = lacks_meshio;
    for (const std::string &python : python_interpreters())
      if (status = run_process({python, script.string(), fs::absolute(file).string(), made}, said);
          status != lacks_meshio)
        break;
    if (guard && guard->received() != nullptr)
      throw Interrupted(guard->received() + std::string(" was received during the conversion of the mesh."));
    if (status == lacks_meshio)
      throw InputError(
          "mesh " + file +
          ": the Python package meshio, which converts it, was not found. Install it (on Debian: apt-get "
          "install python3-meshio), set the environment variable VOUSSOIR_PYTHON to a Python interpreter "
          "that has it, or convert the mesh to MSH 4.1 yourself.");
    if (status != 0)
      throw InputError("mesh " + file +
                       ": it cannot be converted. Export it as MSH 4.1 instead. Reason: " + last_line(said));
    try
    {
      return read_gmsh(made, subdivided);
    }
    catch (const InputError &of_made)
    {
      throw InputError(replaced(of_made.what(), made, file)); // the path of the user's file
    }
  }
} // namespace Voussoir
