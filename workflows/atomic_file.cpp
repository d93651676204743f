// SPDX-License-Identifier: Apache-2.0
#include "workflows/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "catalog/input_error.h"

namespace workflows {

void write_whole(const std::filesystem::path& file, const std::string& text) {
  std::error_code unknown;  // what cannot be looked at fails below, with its reason
  if (std::filesystem::is_other(file, unknown))
    throw std::runtime_error(file.string() + ": cannot be replaced: it is a device or a pipe; name a file");
  const std::filesystem::path beside = file.string() + ".part";
  const auto fail = [&](const char* action) {
    throw std::runtime_error(beside.string() + ": cannot " + action + ": " + std::strerror(errno));
  };
  const int descriptor = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) fail("open");
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int reason = errno;
      ::close(descriptor);
      errno = reason;
      fail("write");
    }
    done += static_cast<std::size_t>(written);
  }
  const bool is_flushed = ::fsync(descriptor) == 0;
  if (::close(descriptor) != 0 || !is_flushed) fail("flush");
  std::error_code error;
  std::filesystem::rename(beside, file, error);
  if (error)
    throw std::runtime_error(file.string() + ": cannot be replaced: " +
                             (std::filesystem::is_directory(file) ? "it is a folder; move it out of the way"
                                                                  : error.message() + "; is the folder read-only?"));
}

std::optional<std::string> read_whole(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || std::filesystem::is_directory(file)) return std::nullopt;
  text << stream.rdbuf();  // an empty file sets failbit: nothing to copy, not an error
  return stream.bad() ? std::nullopt : std::optional(text.str());
}

void require_own_place(const std::filesystem::path& file, const std::string& option, const std::string& beginning) {
  namespace fs = std::filesystem;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder))
    throw catalog::InputError(file.string() + ": the folder " + folder.string() +
                              " is not there, expected a place for the file; make it or name another by " + option);
  if (fs::is_directory(file))
    throw catalog::InputError(file.string() + ": is a folder, expected a file; name one by " + option);
  if (!fs::exists(file) || !fs::is_regular_file(file) || fs::file_size(file) == 0) return;
  std::ifstream stream(file, std::ios::binary);
  std::string found(beginning.size(), '\0');
  if (!stream.read(found.data(), static_cast<std::streamsize>(found.size())) || found != beginning)
    throw catalog::InputError(file.string() +
                              ": is there already and is no earlier one of its kind, expected a new name; "
                              "move it away or name another file by " +
                              option);
}

}  // namespace workflows
