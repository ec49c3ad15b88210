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
    /// Creates the directory if it is not there and checks that files can be made in it, before any
    /// work is done.
    ///
    /// # Errors
    /// When the directory cannot be made or does not accept files.
    pub fn open(path: &Path) -> Result<Self, PublishError> {
        let failed = |source| PublishError { path: path.to_owned(), source };
        std::fs::create_dir_all(path).map_err(failed)?;
        temporary_file(path).map_err(failed)?;
        Ok(Self { path: path.to_owned() })
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
        let path = self.path.join(name);
        write_whole(&path, bytes)?;
        Ok(path)
    }
}

/// Writes one file whole or not at all.
///
/// # Errors
/// When the file system refuses.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), PublishError> {
    let failed = |source| PublishError { path: path.to_owned(), source };
    let directory = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let file = temporary_file(directory).map_err(failed)?;
    file.as_file().write_all(bytes).map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
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
