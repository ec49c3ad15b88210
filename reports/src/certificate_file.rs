//! Files of certificates: `{"schema": "courant.certificate/3", "certificates": […]}`.

use crate::publish::{PublishError, write_whole};
use crate::subject::{Sought, Subject, SubjectError};
use courant_analysis::certificate::{
    self, Certificate, CertificateError, CertificationError, Verified, certify_monotonicity,
    certify_stability, verify,
};
use courant_analysis::exact::rational::Rational;
use courant_analysis::scheme::SchemeError;
use courant_analysis::stability::SearchPlan;
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

/// Why limits of a subject have no certificates.
#[derive(Debug, Error)]
pub enum NotCertified {
    /// Nobody could derive the weights of its kernel again.
    #[error("its kernel has no name")]
    Nameless,
    /// The question cannot be asked.
    #[error(transparent)]
    Subject(#[from] SubjectError),
    /// The limits cannot be decided.
    #[error(transparent)]
    Scheme(#[from] SchemeError),
    /// There is no proof.
    #[error(transparent)]
    Proof(#[from] CertificationError),
}

/// Certificates of every limit of a subject: of stability, without growth and within each of the budgets, and of monotonicity.
///
/// # Errors
/// When a limit is not proved, or the kernel has no name.
pub fn certificates(
    subject: &Subject,
    sought: &Sought,
    plan: &SearchPlan,
    budgets: &[Rational],
) -> Result<Vec<Certificate>, NotCertified> {
    let (step, parameter) = (&sought.step, &sought.parameter);
    let stated = certificate::Subject::new(
        &subject.file.equations.text,
        subject.lattice()?.as_ref(),
        subject.integrator.as_deref(),
        step,
        parameter,
    );
    let stated = stated.ok_or(NotCertified::Nameless)?;
    let mut certificates = Vec::new();
    for growth in std::iter::once(&Rational::default()).chain(budgets) {
        let plan = plan.clone().growing(growth.clone());
        certificates.extend(certify_stability(
            &stated,
            &step.stable_set(parameter, &plan)?,
            &plan,
        )?);
    }
    if let Some(set) = step.monotone_set(parameter, plan)? {
        certificates.extend(certify_monotonicity(&stated, &set, &plan.max)?);
    }
    Ok(certificates)
}

/// Writes certificates, whole or not at all.
///
/// # Errors
/// When the file cannot be written.
pub fn write(path: &Path, certificates: &[Certificate]) -> Result<(), CertificateFileError> {
    let text = to_text(certificates)
        .map_err(|error| PublishError { path: path.into(), source: error.into() })?;
    Ok(write_whole(path, text.as_bytes())?)
}

/// The text of a file.
///
/// # Errors
/// Never: certificates are made of what JSON holds.
pub fn to_text(certificates: &[Certificate]) -> Result<String, serde_json::Error> {
    let file = File { schema: SCHEMA.into(), certificates: certificates.to_vec() };
    Ok(serde_json::to_string(&file)? + "\n")
}

/// Reads certificates without believing them.
///
/// # Errors
/// When the file cannot be read or is not a file of certificates.
pub fn read(path: &Path) -> Result<Vec<Certificate>, CertificateFileError> {
    let text = std::fs::read_to_string(path)
        .map_err(|source| CertificateFileError::Access { path: path.into(), source })?;
    parse(path, &text)
}

/// The certificates of a text, which errors call by the name of a file.
///
/// # Errors
/// When it is not the text of a file of certificates.
pub fn parse(path: &Path, text: &str) -> Result<Vec<Certificate>, CertificateFileError> {
    let file: File = serde_json::from_str(text)
        .map_err(|source| CertificateFileError::Malformed { path: path.into(), source })?;
    // Lists would do for records, and a number has one spelling only.
    let malformed = |source| CertificateFileError::Malformed { path: path.into(), source };
    let as_read: serde_json::Value = serde_json::from_str(text).map_err(malformed)?;
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
    verify_all(path, &read(path)?)
}

/// Checks certificates of a file: what each proves.
///
/// # Errors
/// Names the first that does not hold.
pub fn verify_all(
    path: &Path,
    certificates: &[Certificate],
) -> Result<Vec<Verified>, CertificateFileError> {
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
