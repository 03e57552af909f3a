// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_scene_text_h
#define voussoir_scene_text_h

#include <voussoir/app/declared_entries.h>
#include <voussoir/base/entries.h>
#include <voussoir/dam/scene.h>

#include <map>
#include <string>
#include <vector>

namespace Voussoir
{
  /** New input file: entries with values, each with a comment from its help text. */
  class SceneText
  {
  public:
    /** @param file path of the input file; files in entries are relative to its directory */
    explicit SceneText(const std::string &file);

    /** Returns the declaration of an entry, or null. */
    const DeclaredEntry *find(const std::string &name) const;

    /** Sets an entry. Throws InputError for an invalid or unusual value. */
    void set(const std::string &name, const std::string &value);

    /** Adds an entry with its default, if it has no value. */
    void add(const std::string &name) { values.emplace(name, find(name)->default_value); }

    /** Adds the entries of the joints that the joint model reads, and that have a unit. */
    void add_joints();

    /** Adds the entries of the foundation that its model reads. */
    void add_foundation();

    /** Adds the entries of concrete that every dam has, and those of damping if there is a motion. */
    void add_materials();

    /** Returns the text of the input file, without a heading. Throws InputError if the entries contradict one
     * another. */
    std::string text() const;

    /** Writes the input file: @p heading and text(). Throws InputError if the file exists, WriteError if it cannot
     * be written. */
    void write(const std::string &heading) const;

    /** Throws InputError if the file exists, or if its directory does not. */
    void expect_new() const;

    Scene                              scene;  ///< the entries, as read
    std::map<std::string, std::string> values; ///< as written, by entry

  private:
    std::string                file;
    Entries                    prm;
    std::vector<DeclaredEntry> known;
  };

  /** Returns the choices of an entry as ", one of: ...", or an empty text. */
  std::string choices_of(const DeclaredEntry &entry);
} // namespace Voussoir

#endif
