// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_run_directory_h
#define voussoir_run_directory_h

#include <filesystem>
#include <string>
#include <vector>

namespace Voussoir
{
  /** The directory that a run writes to. Nothing in it is touched before the run has read all its input; a
   * checkpoint, and files that the program did not write, are removed by request only; and two runs cannot
   * have it at the same time. The file `.voussoir` in it says that it is the program's, and is locked while a
   * run lasts. */
  class RunDirectory
  {
  public:
    explicit RunDirectory(std::string path) : path(std::move(path)) {}
    ~RunDirectory(); ///< removes what claim() made, if begin() was never called
    RunDirectory(const RunDirectory &) = delete;
    RunDirectory &operator=(const RunDirectory &) = delete;

    /** Makes the directory, if need be, and locks it. @p inputs: files that the run reads. Throws InputError
     * if it cannot be written to, if another run has it, if it holds a checkpoint or files of others (unless
     * @p resume or @p overwrite), or if an input would be overwritten. */
    void claim(bool resume, bool overwrite, const std::vector<std::string> &inputs);

    /** All input has been read and found good: removes the results of an earlier run, unless @p resume; @p
     * keep_problems: but not those below contact/. In a directory of others nothing but a checkpoint is
     * removed. Throws WriteError. */
    void begin(bool resume, bool keep_problems);

    const std::string path; ///< as the user gave it

  private:
    void lock();

    std::vector<std::filesystem::path> created; ///< directories, outermost first
    bool                               begun = false;
    bool                               marked = false; ///< has this object made the marker?
    bool                               ours = false;   ///< is the directory a run's?
    int                                descriptor = -1;
  };
} // namespace Voussoir

#endif
