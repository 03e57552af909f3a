// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_run_directory_h
#define voussoir_run_directory_h

#include <filesystem>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Output directory of a run. Its files are unchanged until the run has read all its input (begin()). A
   * checkpoint, and files of other programs, are removed only on request. Two runs cannot use a directory
   * simultaneously, because a run locks the file `.voussoir` in the directory. */
  class RunDirectory
  {
  public:
    /** @p path: path of the directory, which claim() creates. */
    explicit RunDirectory(std::string path) : path(std::move(path)) {}

    /** Removes the lock, and the files and directories of claim() if begin() was not called. */
    ~RunDirectory();
    RunDirectory(const RunDirectory &) = delete;
    RunDirectory &operator=(const RunDirectory &) = delete;

    /** Creates the directory if necessary, and locks it.
     *
     * @param resume true: the run continues a checkpoint
     * @param overwrite true: existing files may be replaced
     * @param inputs names of the files that the run reads
     *
     * Throws InputError if the directory cannot be written to, if another run uses it, or if an input would
     * be overwritten. Without @p resume and @p overwrite, also if it contains a checkpoint or other files. */
    void claim(bool resume, bool overwrite, const std::vector<std::string> &inputs);

    /** Removes the results of an earlier run, after all input was read. In a directory with files of other
     * programs only a checkpoint is removed.
     * @param resume true: no file is removed
     * @param keep_problems true: the files in contact/ are not removed
     *
     * Throws WriteError. */
    void begin(bool resume, bool keep_problems);

    /** Removes the results of a run from a directory, and the directory if it has no other files. */
    static void remove_results(const std::string &path);

    /** Throws WriteError if a table that exists at the first call does not exist at a later one. */
    void expect_tables();

    const std::string path; ///< path of the directory, as on the command line

  private:
    void lock();

    std::vector<std::filesystem::path> created;         ///< directories, outermost first
    std::vector<std::filesystem::path> tables;          ///< of the first expect_tables()
    bool                               begun = false;   ///< begin() was called
    bool                               marked = false;  ///< this object created the marker
    bool                               ours = false;    ///< the directory is one of an earlier run
    int                                descriptor = -1; ///< of the marker
  };
} // namespace Voussoir

#endif
