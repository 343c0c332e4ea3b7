"""A tree of files as one word, which a command that only reads leaves as it was."""

import os
from hashlib import sha256
from pathlib import Path


def digest(root: Path, *, folders_dates: bool = True) -> str:
    """Of all names, kinds, contents, links, rights and dates below the folder.

    folders_dates: also when something was last made or taken away in each folder.
    """
    found = sha256()
    for folder, folders, files in os.walk(root):
        folders.sort()
        for name in sorted([*folders, *files]):
            path = Path(folder) / name
            stat = path.lstat()
            dated = folders_dates or name in files
            when = stat.st_mtime_ns if dated else 0
            told = (str(path.relative_to(root)), stat.st_mode, stat.st_ino, when)
            found.update(repr(told).encode())
            if path.is_symlink():
                found.update(os.readlink(path).encode(errors="surrogateescape"))
            elif path.is_file():
                found.update(path.read_bytes())
    return found.hexdigest()
