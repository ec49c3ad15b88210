//! Writing files so that they appear whole or not at all.

use std::io::Write;
use std::path::{Path, PathBuf};

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write `{}`: {source}", path.display())]
pub struct PublishError {
    /// The file or directory.
    pub path: PathBuf,
    /// What the system said.
    pub source: std::io::Error,
}

/// A directory that accepts files.
///
/// ```
/// use courant_reports::publish::OutputDirectory;
/// let place = tempfile::tempdir()?;
/// let output = OutputDirectory::open(&place.path().join("out"))?;
/// let path = output.write("table.csv", b"a,b\n")?;
/// assert_eq!(std::fs::read(path)?, b"a,b\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct OutputDirectory {
    path: PathBuf,
}

impl OutputDirectory {
    /// Checks that files can be made in the directory, before any work is done. It is made itself, where it is not
    /// there, with the first file: input that is refused later leaves nothing behind.
    ///
    /// # Errors
    /// When the directory, or the nearest one above it that is there, does not accept files.
    pub fn open(path: &Path) -> Result<Self, PublishError> {
        let failed = |source| PublishError { path: path.to_owned(), source };
        let there = path.ancestors().find(|above| above.symlink_metadata().is_ok());
        temporary_file(there.unwrap_or(Path::new("."))).map_err(failed)?;
        Ok(Self { path: path.to_owned() })
    }

    /// A directory in it.
    pub fn below(&self, name: &str) -> Self {
        Self { path: self.path.join(name) }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a file beside its place and moves it there when it is complete.
    ///
    /// # Errors
    /// When the file system refuses.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, PublishError> {
        self.prepare(name, bytes)?.publish()
    }

    /// Writes a file beside its place, where it stays until it is [published](Prepared::publish): of several that belong together
    /// one can be written while another is made.
    ///
    /// # Errors
    /// When the file system refuses.
    pub fn prepare(&self, name: &str, bytes: &[u8]) -> Result<Prepared, PublishError> {
        std::fs::create_dir_all(&self.path)
            .map_err(|source| PublishError { path: self.path.clone(), source })?;
        Prepared::new(&self.path.join(name), bytes)
    }
}

/// A file that is written but not in its place; it goes away unless it is published.
#[derive(Debug)]
pub struct Prepared {
    path: PathBuf,
    /// Absent when a device or a pipe has taken the bytes.
    file: Option<tempfile::NamedTempFile<std::fs::File>>,
}

impl Prepared {
    fn new(path: &Path, bytes: &[u8]) -> Result<Self, PublishError> {
        let failed = |source| PublishError { path: path.to_owned(), source };
        match std::fs::metadata(path) {
            Ok(there) if !there.is_file() => {
                let mut taker =
                    std::fs::OpenOptions::new().write(true).open(path).map_err(failed)?;
                taker.write_all(bytes).map_err(failed)?;
                return Ok(Self { path: path.to_owned(), file: None });
            }
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(failed(error));
            }
            _ => {}
        }
        let file = temporary_file(directory_of(&behind_links(path))).map_err(failed)?;
        file.as_file().write_all(bytes).map_err(failed)?;
        Ok(Self { path: path.to_owned(), file: Some(file) })
    }

    /// Moves the file to its place, which is returned.
    ///
    /// # Errors
    /// When the file system refuses.
    pub fn publish(self) -> Result<PathBuf, PublishError> {
        if let Some(file) = self.file {
            let moved = file.persist(behind_links(&self.path));
            moved.map_err(|error| PublishError { path: self.path.clone(), source: error.error })?;
        }
        Ok(self.path)
    }
}

/// Writes one file whole or not at all. A symbolic link stays, and what it leads to is written; what is no file, such
/// as a device or a pipe, takes the bytes and stays as well.
///
/// # Errors
/// When the file system refuses.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), PublishError> {
    Prepared::new(path, bytes)?.publish().map(|_| ())
}

/// Where links lead in the end, also when nothing is there yet; there are no circles where the system found none.
fn behind_links(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    while let Ok(target) = std::fs::read_link(&path) {
        path = directory_of(&path).join(target);
    }
    path
}

fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// A file with the permissions of any other, which goes away unless it is moved to its place. Its errors
/// are those of the system alone: nobody asked for its name.
fn temporary_file(directory: &Path) -> std::io::Result<tempfile::NamedTempFile<std::fs::File>> {
    tempfile::Builder::new().make_in(directory, |path| std::fs::File::create_new(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_in_the_way_of_the_directory_is_an_error_and_leaves_nothing() {
        let place = tempfile::tempdir().unwrap();
        let file = place.path().join("file");
        std::fs::write(&file, "x").unwrap();
        let error = OutputDirectory::open(&file.join("below")).unwrap_err();
        assert!(error.to_string().contains("below"), "{error}");
        assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_directory_that_is_not_there_is_named_and_nothing_else() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("none").join("a");
        let error = write_whole(&path, b"x").unwrap_err();
        let system = std::fs::write(&path, b"x").unwrap_err();
        assert_eq!(error.to_string(), format!("cannot write `{}`: {system}", path.display()));
    }

    #[test]
    fn a_directory_is_made_with_its_first_file() {
        let place = tempfile::tempdir().unwrap();
        let output = OutputDirectory::open(&place.path().join("a").join("b")).unwrap();
        assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 0);
        assert!(output.write("c", b"x").unwrap().exists());
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_and_what_they_lead_to_is_written() {
        let place = tempfile::tempdir().unwrap();
        let at = |name: &str| place.path().join(name);
        std::fs::create_dir(at("below")).unwrap();
        std::fs::write(at("below/old"), b"old").unwrap();
        for (link, target) in [("a", "below/old"), ("b", "a"), ("c", "below/new")] {
            std::os::unix::fs::symlink(target, at(link)).unwrap();
        }
        for (link, target) in [("b", "below/old"), ("c", "below/new")] {
            write_whole(&at(link), link.as_bytes()).unwrap();
            assert!(at(link).is_symlink() && at("a").is_symlink());
            assert_eq!(std::fs::read_to_string(at(target)).unwrap(), link);
        }
        std::os::unix::fs::symlink("circle", at("circle")).unwrap();
        assert!(write_whole(&at("circle"), b"x").is_err() && at("circle").is_symlink());
        assert_eq!(std::fs::read_dir(at("below")).unwrap().count(), 2);
    }

    #[cfg(unix)]
    #[test]
    fn a_result_can_be_read_by_whom_any_file_can() {
        use std::os::unix::fs::PermissionsExt;
        let place = tempfile::tempdir().unwrap();
        let (ours, other) = (place.path().join("ours"), place.path().join("other"));
        write_whole(&ours, b"x").unwrap();
        std::fs::write(&other, b"x").unwrap();
        let mode = |path| std::fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(ours), mode(other));
    }

    #[test]
    fn writing_replaces_and_leaves_no_temporary_file() {
        let place = tempfile::tempdir().unwrap();
        let output = OutputDirectory::open(place.path()).unwrap();
        output.write("a", b"old").unwrap();
        output.write("a", b"new").unwrap();
        assert_eq!(std::fs::read(place.path().join("a")).unwrap(), b"new");
        assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 1);
    }
}
