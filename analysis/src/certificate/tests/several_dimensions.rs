use super::*;

fn torus(certificate: &Certificate) -> TorusProof {
    match &certificate.proof {
        Proof::Torus(torus) => torus.clone(),
        Proof::Line(_) => panic!("one phase"),
    }
}

#[test]
fn limits_in_two_and_three_dimensions_are_those_of_the_literature() {
    for (name, limit) in [
        ("lax-wendroff-2d", "C = sqrt(1/8)"),
        ("donor-cell-2d", "C = 1/2"),
        ("heat-9-point-2d", "r = 3/8"),
        ("corner-transport-upwind-2d", "C = 1"),
        ("lax-wendroff-2d-no-cross", "C = 0"),
        ("yee-3d", "C = sqrt(1/3)"),
        ("lax-wendroff-3d", "C = sqrt(1/27)"),
    ] {
        let expected = format!("|z| <= 1 + 0 for all waves up to {limit} and not just above");
        assert_eq!(statements(&of_scheme(name)), [expected], "{name}");
    }
    let implicit = statements(&of_scheme("heat-crank-nicolson-2d"));
    assert_eq!(implicit, ["|z| <= 1 + 0 for all waves without end"]);
}

#[test]
fn the_binding_wave_may_be_a_direction_of_long_waves() {
    // Along the diagonal: y → 0 with x = y.
    let wave = torus(&of_scheme("lax-wendroff-2d")[0]).above.unwrap().wave;
    assert_eq!((wave.cube.as_str(), wave.way.as_str()), ("00", "{xy}y"));
    assert_eq!(wave.point, [integer(1).into(), integer(0).into()]);
}

#[test]
fn an_interval_in_two_dimensions_may_begin_above_0() {
    // Implicit and downwind along the first axis, nothing along the second one.
    let found = of_text("u[n+1,i,j] + C*(u[n+1,i+1,j] - u[n+1,i,j]) = u[n,i,j]", "C");
    assert!(torus(&found[1]).below.is_some());
    let statements = statements(&found);
    assert_eq!(statements[0], "|z| <= 1 + 0 for all waves up to C = 0 and not just above");
    assert!(statements[1].ends_with(" without end"), "{statements:?}");
    // Stable from C = 1 on; the search encloses where stability returns.
    let begin = found[1].interval.begin.square().unwrap();
    assert!(integer(1) <= begin && begin < ratio(1_000_001, 1_000_000), "{begin}");
}

#[test]
fn what_no_certificate_can_state_is_said() {
    let text = "u[n+1,i,j] = u[n,i,j] - sqrt(2)*C*(2*u[n,i,j] - u[n,i-1,j] - u[n,i,j-1])";
    let step = Step::from_text(text).unwrap();
    let subject = Subject::new(text, None, None, &step, "C").unwrap();
    let refused = certify(&subject, &step, &SearchPlan::default());
    assert!(refused.is_err(), "{refused:?}");
    // Three equal equations have three equal multipliers; two are not too many.
    let names = ["u", "v", "w"];
    let equal = names.map(|name| {
        "x[n+1,i,j] = x[n,i,j] - C*(2*x[n,i,j] - x[n,i-1,j] - x[n,i,j-1])".replace('x', name)
    });
    let certified = |count: usize| {
        let text = equal[..count].join("; ");
        let step = Step::from_text(&text).unwrap();
        let subject = Subject::new(&text, None, None, &step, "C").unwrap();
        certify(&subject, &step, &SearchPlan::default().growing(ratio(1, 1000)))
    };
    assert!(certified(2).is_ok());
    let refused = certified(3).unwrap_err().to_string();
    assert!(refused.contains("multipliers come three times"), "{refused}");
}

#[test]
fn a_wrong_proof_on_the_torus_is_refused() {
    let valid = of_scheme("lax-wendroff-2d").remove(0);
    let refused = |change: &dyn Fn(&mut Certificate, &mut TorusProof)| {
        let (mut wrong, mut proof) = (valid.clone(), torus(&valid));
        change(&mut wrong, &mut proof);
        wrong.proof = Proof::Torus(proof);
        verify(&wrong).unwrap_err().0
    };
    // 3/8 is a little above √(1/8).
    let further = refused(&|certificate, proof| {
        let end = End::Fraction(ratio(3, 8));
        let begin = certificate.interval.begin.clone();
        certificate.interval = Interval { begin, lower: end.clone(), upper: Some(end) };
        for cell in &mut proof.inequalities[0].cells {
            cell.pieces[0].end = End::Fraction(ratio(9, 64));
        }
    });
    assert_eq!(further, "a box is not decided");
    let fewer = refused(&|_, proof| drop(proof.inequalities[0].cells.pop()));
    assert_eq!(fewer, "not all waves are covered");
    let uncut = refused(&|_, proof| {
        for cell in &mut proof.inequalities[0].cells {
            cell.pieces[0].cuts = vec![".".into(), ".".into()];
        }
    });
    assert_eq!(uncut, "a box is not decided");
    // Half turns would forget the waves along the other diagonal.
    let folded = refused(&|_, proof| {
        proof.inequalities[0].cells.truncate(1);
        proof.inequalities[0].cells[0].cube = "hh".into();
    });
    assert_eq!(folded, "not all waves are covered");
    let stable = refused(&|_, proof| proof.above.as_mut().unwrap().wave.way = "{xy}x".into());
    assert_eq!(stable, "the wave does not grow throughout");
}

#[test]
fn a_limit_without_a_closed_form_is_enclosed() {
    // Long waves of a direction that is no fraction bind: C = (1 + a^{2/3})^{−3/2}.
    let file = catalogue::scheme("lax-wendroff-2d").unwrap();
    let step = file.step(None, None, &[("a".into(), ratio(2, 3))], Some("C")).unwrap();
    let subject = Subject::new(&file.equations.text, None, None, &step, "C").unwrap();
    let all = certify(&subject, &step, &SearchPlan::default()).unwrap();
    verify(&all[0]).unwrap();
    let limit = (1.0 + (2.0f64 / 3.0).powf(2.0 / 3.0)).powf(-1.5);
    let Interval { lower, upper, .. } = &all[0].interval;
    for end in [lower, upper.as_ref().unwrap()] {
        let found = crate::exact::rational::to_f64(&end.square().unwrap()).sqrt();
        assert!((found / limit - 1.0).abs() < 1e-6, "{found} for {limit}");
    }
}
