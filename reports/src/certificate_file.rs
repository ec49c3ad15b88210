//! Files of certificates: `{"schema": "courant.certificate/3", "certificates": […]}`.

use crate::publish::{PublishError, write_whole};
use courant_analysis::certificate::{Certificate, CertificateError, Verified, verify};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The name and version of the format.
pub const SCHEMA: &str = "courant.certificate/3";

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    schema: String,
    certificates: Vec<Certificate>,
}

/// Why a file of certificates cannot be written, read or believed.
#[derive(Debug, Error)]
pub enum CertificateFileError {
    /// The file cannot be written.
    #[error(transparent)]
    Publish(#[from] PublishError),
    /// The file cannot be opened or read.
    #[error("{path}: {source}", path = .path.display())]
    Access {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file is not JSON of this format.
    #[error("{path}: not a file of certificates: {source}", path = .path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Where and what.
        source: serde_json::Error,
    },
    /// The file has another schema, or no certificate in it.
    #[error("{path}: expected schema `{SCHEMA}` with at least one certificate", path = .0.display())]
    OtherSchema(PathBuf),
    /// A certificate does not hold.
    #[error("{path}: certificate {index}: {source}", path = .path.display())]
    Refused {
        /// The file.
        path: PathBuf,
        /// Which one, counted from 0.
        index: usize,
        /// What does not hold.
        source: CertificateError,
    },
}

/// Writes certificates, whole or not at all.
///
/// # Errors
/// When the file cannot be written.
pub fn write(path: &Path, certificates: &[Certificate]) -> Result<(), CertificateFileError> {
    let file = File { schema: SCHEMA.into(), certificates: certificates.to_vec() };
    let mut text = serde_json::to_vec(&file)
        .map_err(|error| PublishError { path: path.into(), source: error.into() })?;
    text.push(b'\n');
    Ok(write_whole(path, &text)?)
}

/// Reads certificates without believing them.
///
/// # Errors
/// When the file cannot be read or is not a file of certificates.
pub fn read(path: &Path) -> Result<Vec<Certificate>, CertificateFileError> {
    let text = std::fs::read_to_string(path)
        .map_err(|source| CertificateFileError::Access { path: path.into(), source })?;
    let file: File = serde_json::from_str(&text)
        .map_err(|source| CertificateFileError::Malformed { path: path.into(), source })?;
    // Lists would do for records, and a number has one spelling only.
    let malformed = |source| CertificateFileError::Malformed { path: path.into(), source };
    let as_read: serde_json::Value = serde_json::from_str(&text).map_err(malformed)?;
    if serde_json::to_value(&file).map_err(malformed)? != as_read {
        let source = serde::de::Error::custom("it is not written in the one way there is");
        return Err(malformed(source));
    }
    if file.schema != SCHEMA || file.certificates.is_empty() {
        return Err(CertificateFileError::OtherSchema(path.into()));
    }
    Ok(file.certificates)
}

/// Reads and checks: what each certificate proves.
///
/// # Errors
/// When the file cannot be read, or names the first certificate that does not hold.
pub fn verify_file(path: &Path) -> Result<Vec<Verified>, CertificateFileError> {
    let certificates = read(path)?;
    let checked = certificates.iter().enumerate().map(|(index, certificate)| {
        verify(certificate).map_err(|source| CertificateFileError::Refused {
            path: path.into(),
            index,
            source,
        })
    });
    checked.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use courant_analysis::certificate::{Subject, certify};
    use courant_analysis::scheme::Step;
    use courant_analysis::stability::SearchPlan;

    #[test]
    fn what_is_written_is_read_and_holds_until_it_is_changed() {
        let text = "u[n+1,j] = u[n,j] - 8*C/15*(u[n,j] - u[n,j-1])";
        let step = Step::from_text(text).unwrap();
        let subject = Subject::new(text, None, None, &step, "C").unwrap();
        let certificates = certify(&subject, &step, &SearchPlan::default()).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("limits.json");
        write(&path, &certificates).unwrap();
        assert_eq!(read(&path).unwrap(), certificates);
        assert!(verify_file(&path).unwrap()[0].statement.contains("C = 15/8"));

        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, text.replace("15/8", "19/10")).unwrap();
        assert!(matches!(verify_file(&path), Err(CertificateFileError::Refused { .. })));
        std::fs::write(&path, text.replace("certificate/3", "certificate/2")).unwrap();
        assert!(matches!(read(&path), Err(CertificateFileError::OtherSchema(_))));
        std::fs::write(&path, &text[..text.len() / 2]).unwrap();
        assert!(matches!(read(&path), Err(CertificateFileError::Malformed { .. })));
        assert!(matches!(
            read(&folder.path().join("none.json")),
            Err(CertificateFileError::Access { .. })
        ));
    }
}
