// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/output_file.h>
#include <voussoir/output/run_directory.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <regex>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace Voussoir
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr const char *marker = ".voussoir";

    /** Returns a path relative to the directory of the run that writes it: without "motion-3" of an ensemble. */
    fs::path in_own_run(const fs::path &relative)
    {
      static const std::regex motion("motion-[0-9]+");
      if (relative.empty() || !std::regex_match(relative.begin()->string(), motion))
        return relative;
      return std::next(relative.begin()) == relative.end() ? fs::path()
                                                           : relative.lexically_relative(*relative.begin());
    }

    /** Returns true if a run writes a file of this path, relative to its directory. */
    bool is_result(const fs::path &path)
    {
      const fs::path    relative = in_own_run(path);
      const std::string name = relative.filename().string(), folder = relative.parent_path().string();
      if (folder == "figures")
      {
        static const std::regex figure(
            "envelope_((arch|cantilever|vertical)_)?(up|down)stream(_compression)?|"
            "openings|slips|history|joint_history|spectrum|floor_spectra|energy|distribution|ida|"
            "demand_(up|down)stream|overstress");
        const auto format = relative.extension();
        return (format == ".png" || format == ".svg" || format == ".pdf") &&
               std::regex_match(relative.stem().string(), figure);
      }
      if (folder == "contact/static" || folder == "contact/shaking")
        return std::regex_match(name, std::regex("problem-[0-9]{6}\\.(txt|hdf5)"));
      static const std::regex result(
          "scene\\.prm|log\\.txt|summary\\.json|(ensemble|ensemble_joints|history|energy|stages|blocks|joints|joint_history|joint_"
          "points|joint_cells|joint_pressures|spectrum|floor_spectra|faces|faces_cells|wedges|water_"
          "pressure)\\.csv|envelope\\.vtu|solution\\."
          "pvd|(solution|joints)-[0-9]{5,}\\.vtu|report\\.(html|pdf)|figures\\.log|checkpoint\\.txt|"
          "frames\\.bin|checkpoint\\.bin(\\.before|\\.new)?|\\.voussoir");
      return folder.empty() && std::regex_match(name, result);
    }

    /** Returns true for a directory or a device in the place of a result, such as /dev/full in tests. */
    bool is_in_the_way(const fs::path &place)
    {
      std::error_code error;
      const auto      type = fs::status(place, error).type();
      return type == fs::file_type::directory || type == fs::file_type::character;
    }

    /** Returns the entries of an output directory, relative to it. Folders that a run does not create, and
     * links to folders, are entries. */
    std::vector<fs::path> entries_of(const fs::path &directory)
    {
      std::vector<fs::path> entries;
      const auto            is_folder = [&](const fs::path &relative)
      {
        const fs::path of_run = in_own_run(relative);
        return (of_run.empty() || of_run == "figures" || of_run == "contact" || of_run == "contact/static" ||
                of_run == "contact/shaking") &&
               fs::is_directory(fs::symlink_status(directory / relative));
      };
      const std::function<void(const fs::path &)> look = [&](const fs::path &folder)
      {
        std::error_code        error;
        fs::directory_iterator inside(directory / folder, error);
        if (error)
          throw InputError("The output directory " + directory.string() +
                           " cannot be read: " + error.message() + ". Choose another one with --output.");
        for (const auto &entry : inside)
          if (const fs::path relative = folder / entry.path().filename(); is_folder(relative))
            look(relative);
          else
            entries.push_back(relative);
      };
      look("");
      std::sort(entries.begin(), entries.end());
      return entries;
    }
  } // namespace

  RunDirectory::~RunDirectory()
  {
    std::error_code ignored;
    if (!begun)
    {
      if (marked)
        fs::remove(fs::path(path) / marker, ignored);
      for (auto made = created.rbegin(); made != created.rend(); ++made)
        fs::remove(*made, ignored); // if it is empty
    }
    if (descriptor >= 0)
      close(descriptor);
  }

  void RunDirectory::lock()
  {
    const std::string file = (fs::path(path) / marker).string();
    for (;;)
    {
      std::error_code error;
      marked = !fs::exists(file, error);
      descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (descriptor < 0)
        throw InputError("The output directory " + path +
                         " cannot be written to. Choose another one with --output.");
      const bool  locked = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
      struct stat opened = {}, there = {};
      if (!locked && errno == EWOULDBLOCK) // file systems without locks are accepted
      {
        close(descriptor);
        descriptor = -1;
        marked = false; // marker of the other run
        std::string   owner;
        std::ifstream in(file);
        std::getline(in, owner);
        throw InputError("Another run is writing to the output directory " + path + " (" + owner +
                         "). Wait until it has ended, or choose another directory with --output.");
      }
      if (fstat(descriptor, &opened) == 0 && stat(file.c_str(), &there) == 0 &&
          opened.st_ino == there.st_ino && opened.st_dev == there.st_dev)
        break;
      close(descriptor); // another run removed it in the meantime
      descriptor = -1;
    }
    const std::string owner = "output of voussoir, process " + std::to_string(getpid()) + "\n";
    if (ftruncate(descriptor, 0) != 0 ||
        write(descriptor, owner.data(), owner.size()) != static_cast<ssize_t>(owner.size()))
      throw InputError("The file " + file +
                       " cannot be written. Free disk space, or choose another directory with --output.");
  }

  void RunDirectory::claim(const bool resume, const bool overwrite, const std::vector<std::string> &inputs)
  {
    std::error_code error;
    for (fs::path p = fs::absolute(path).lexically_normal();
         !fs::exists(p, error) && p.has_relative_path() && p != p.parent_path(); p = p.parent_path())
      if (p.has_filename())
        created.insert(created.begin(), p);
    fs::create_directories(path, error);
    if (error || !fs::is_directory(path, error))
      throw InputError("The output directory " + path +
                       " cannot be created or written to. Choose another one with --output.");
    lock();
    const auto has = [&](const char *name) { return fs::exists(fs::path(path) / name, error); };
    ours = !marked || (has("scene.prm") && has("log.txt")); // version 0.1 left no marker
    std::vector<std::string> foreign;
    for (const fs::path &entry : entries_of(path))
      if (entry != marker && (!is_result(entry) || (!ours && !is_in_the_way(path / entry))))
        foreign.push_back(entry.string());

    if (!resume)
      for (const std::string &input : inputs)
      {
        const fs::path file = fs::weakly_canonical(input, error); // resolves links
        if (is_result(file.filename()) && fs::equivalent(file.parent_path(), path, error))
          throw InputError("The run would overwrite its own input " + input + " in the output directory " +
                           path + ". Choose another one with --output.");
      }
    if (resume || overwrite)
      return;
    for (const char *name : {"checkpoint.bin", "checkpoint.bin.before"})
      if (ours && has(name))
        throw InputError(
            "The output directory " + path +
            " holds the checkpoint of a run that has not ended. Continue it with --resume, replace it "
            "with --overwrite, or choose another directory with --output.");
    if (!foreign.empty())
      throw InputError(
          "The output directory " + path + " holds files that no run of this program wrote there: " +
          foreign[0] + (foreign.size() > 1 ? " and " + std::to_string(foreign.size() - 1) + " more" : "") +
          ". Choose another directory with --output, or use --overwrite. It keeps these files, except those "
          "with the name of a result.");
  }

  void RunDirectory::begin(const bool resume, const bool keep_problems)
  {
    begun = true;
    if (resume)
      return;
    for (const fs::path &entry : entries_of(path))
    {
      const fs::path place = path / entry;
      const bool     is_problem = !entry.parent_path().empty() && *entry.begin() == "contact";
      // In a directory of another program only checkpoints and links are removed. Other files are replaced.
      const bool      removed = ours ? is_result(entry) && !(keep_problems && is_problem)
                                     : is_result(entry) && (entry.string().compare(0, 10, "checkpoint") == 0 ||
                                                       fs::is_symlink(place));
      std::error_code error;
      if (removed && entry != marker && !is_in_the_way(place) && (!fs::remove(place, error) || error))
        throw WriteError("The old result " + place.string() +
                         " cannot be removed. Remove it, or choose another directory with --output.");
    }
  }

  void RunDirectory::remove_results(const std::string &path)
  {
    std::error_code ignored;
    for (const fs::path &entry : entries_of(path))
      if (is_result(entry))
        fs::remove(path / entry, ignored);
    for (const char *folder : {"figures", "contact/static", "contact/shaking", "contact", "."})
      fs::remove((path / fs::path(folder)).lexically_normal(), ignored); // if it is empty
  }

  void RunDirectory::expect_tables()
  {
    std::error_code error;
    if (!fs::is_directory(path, error))
      throw WriteError(
          "The output directory " + path +
          "/ was removed, or the directory renamed, while the program was running: it no longer exists. "
          "Please start the run again, or choose another directory with --output.");
    if (tables.empty())
      for (const fs::path &entry : entries_of(path))
        if (const fs::path ending = entry.extension();
            is_result(entry) && entry.parent_path().empty() &&
            (ending == ".csv" || ending == ".prm" || ending == ".txt"))
          tables.push_back(entry);
    for (const fs::path &table : tables)
      if (!fs::exists(path / table, error))
        throw WriteError("The file " + (fs::path(path) / table).string() +
                         " was removed while the program was running.");
  }
} // namespace Voussoir
