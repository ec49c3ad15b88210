use super::*;
use crate::exact::rational::integer;
use crate::scheme::catalogue;
use crate::stability::{Demands, Evidence, SearchPlan};

#[test]
fn both_roads_agree_in_one_dimension() {
    let mut compared = 0;
    for entry in catalogue::schemes() {
        let Some(parameter) = entry.parameter.as_deref() else { continue };
        let Ok(step) = entry.step(None, None, &[], Some(parameter)) else { continue };
        if step.dimension() != 1 {
            continue;
        }
        // As if its line were a torus.
        let variable = step.names().parameter(parameter);
        let demands = step.demands_on_torus(&step.characteristic().unwrap(), variable, &integer(0));
        let Demands::OnTorus(demands) = demands else { continue };
        let plan = SearchPlan::default().up_to(integer(20));
        let known = step.stable_set(parameter, &plan).unwrap();
        let found = stable_set_on_torus(&demands, &plan);
        let name = &entry.name;
        if !found.undecided.is_empty() {
            eprintln!("{name}: {:?} {:?}", found.undecided, found.work);
            continue;
        }
        assert_eq!(found.intervals.len(), known.intervals.len(), "{name}");
        for (found, known) in found.intervals.iter().zip(&known.intervals) {
            assert_ne!(found.to.evidence(), Evidence::Undecided, "{name}");
            for (found, known) in [(&found.from, &known.from), (&found.to, &known.to)] {
                assert_eq!(found.is_unbounded(), known.is_unbounded(), "{name}");
                // Each encloses the limit to 2^−52 of itself, widened where touching waves resist.
                let same = found.lower() <= known.upper() * (1.0 + 1e-13)
                    && known.lower() <= found.upper() * (1.0 + 1e-13);
                assert!(same, "{name}: {found:?} {known:?}");
            }
        }
        compared += 1;
    }
    assert!(compared > 50, "{compared}");
}
