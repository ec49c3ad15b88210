//! Limits in two and three dimensions.

use courant_analysis::scheme::Step;

#[test]
fn show() {
    for (name, text) in [
        ("donor", "u[n+1,i,j] = u[n,i,j] - C*(u[n,i,j] - u[n,i-1,j]) - C*(u[n,i,j] - u[n,i,j-1])"),
        (
            "ctu",
            "u[n+1,i,j] = (1-C)^2*u[n,i,j] + C*(1-C)*(u[n,i-1,j]+u[n,i,j-1]) + C^2*u[n,i-1,j-1]",
        ),
        (
            "lw",
            "u[n+1,i,j] = u[n,i,j] - C/2*(u[n,i+1,j]-u[n,i-1,j]) - C/2*(u[n,i,j+1]-u[n,i,j-1]) + C^2/2*(u[n,i+1,j]-2*u[n,i,j]+u[n,i-1,j]) + C^2/2*(u[n,i,j+1]-2*u[n,i,j]+u[n,i,j-1]) + C^2/4*(u[n,i+1,j+1]-u[n,i+1,j-1]-u[n,i-1,j+1]+u[n,i-1,j-1])",
        ),
        (
            "heat",
            "u[n+1,i,j] = u[n,i,j] + C*(u[n,i+1,j]+u[n,i-1,j]+u[n,i,j+1]+u[n,i,j-1]-4*u[n,i,j])",
        ),
        (
            "heat9",
            "u[n+1,i,j] = u[n,i,j] + C/6*(4*(u[n,i+1,j]+u[n,i-1,j]+u[n,i,j+1]+u[n,i,j-1])+u[n,i+1,j+1]+u[n,i+1,j-1]+u[n,i-1,j+1]+u[n,i-1,j-1]-20*u[n,i,j])",
        ),
        (
            "wave2",
            "u[n+1,i,j] = 2*u[n,i,j] - u[n-1,i,j] + C^2*(u[n,i+1,j]+u[n,i-1,j]+u[n,i,j+1]+u[n,i,j-1]-4*u[n,i,j])",
        ),
        (
            "heat7",
            "u[n+1,i,j,k] = u[n,i,j,k] + C*(u[n,i+1,j,k]+u[n,i-1,j,k]+u[n,i,j+1,k]+u[n,i,j-1,k]+u[n,i,j,k-1]+u[n,i,j,k+1]-6*u[n,i,j,k])",
        ),
        (
            "yee2",
            "h[n+1/2,i,j+1/2] = h[n-1/2,i,j+1/2] - C*(e[n,i,j+1]-e[n,i,j]); g[n+1/2,i+1/2,j] = g[n-1/2,i+1/2,j] + C*(e[n,i+1,j]-e[n,i,j]); e[n+1,i,j] = e[n,i,j] + C*(g[n+1/2,i+1/2,j]-g[n+1/2,i-1/2,j]) - C*(h[n+1/2,i,j+1/2]-h[n+1/2,i,j-1/2])",
        ),
        (
            "yee3",
            "x[n+1,i+1/2,j,k] = x[n,i+1/2,j,k] + C*(c[n+1/2,i+1/2,j+1/2,k]-c[n+1/2,i+1/2,j-1/2,k]-b[n+1/2,i+1/2,j,k+1/2]+b[n+1/2,i+1/2,j,k-1/2]); y[n+1,i,j+1/2,k] = y[n,i,j+1/2,k] + C*(a[n+1/2,i,j+1/2,k+1/2]-a[n+1/2,i,j+1/2,k-1/2]-c[n+1/2,i+1/2,j+1/2,k]+c[n+1/2,i-1/2,j+1/2,k]); z[n+1,i,j,k+1/2] = z[n,i,j,k+1/2] + C*(b[n+1/2,i+1/2,j,k+1/2]-b[n+1/2,i-1/2,j,k+1/2]-a[n+1/2,i,j+1/2,k+1/2]+a[n+1/2,i,j-1/2,k+1/2]); a[n+1/2,i,j+1/2,k+1/2] = a[n-1/2,i,j+1/2,k+1/2] - C*(z[n,i,j+1,k+1/2]-z[n,i,j,k+1/2]-y[n,i,j+1/2,k+1]+y[n,i,j+1/2,k]); b[n+1/2,i+1/2,j,k+1/2] = b[n-1/2,i+1/2,j,k+1/2] - C*(x[n,i+1/2,j,k+1]-x[n,i+1/2,j,k]-z[n,i+1,j,k+1/2]+z[n,i,j,k+1/2]); c[n+1/2,i+1/2,j+1/2,k] = c[n-1/2,i+1/2,j+1/2,k] - C*(y[n,i+1,j+1/2,k]-y[n,i,j+1/2,k]-x[n,i+1/2,j+1,k]+x[n,i+1/2,j,k])",
        ),
        (
            "up3",
            "u[n+1,i,j,k] = u[n,i,j,k] - C*(3*u[n,i,j,k] - u[n,i-1,j,k]- u[n,i,j-1,k]- u[n,i,j,k-1])",
        ),
        (
            "cn2",
            "u[n+1,i,j] -u[n,i,j] + C/4*(u[n+1,i+1,j]-u[n+1,i-1,j]+u[n,i+1,j]-u[n,i-1,j]) + C/4*(u[n+1,i,j+1]-u[n+1,i,j-1]+u[n,i,j+1]-u[n,i,j-1])=0",
        ),
        (
            "ftcs",
            "u[n+1,i,j] = u[n,i,j] - C/2*(u[n,i+1,j]-u[n,i-1,j]) - C/2*(u[n,i,j+1]-u[n,i,j-1])",
        ),
        (
            "fromm",
            "u[n+1,i,j] = u[n,i,j] - C*(u[n,i,j]-u[n,i-1,j]) - C*(1-C)/4*(u[n,i+1,j]-u[n,i,j]-u[n,i-1,j]+u[n,i-2,j]) - C*(u[n,i,j]-u[n,i,j-1]) - C*(1-C)/4*(u[n,i,j+1]-u[n,i,j]-u[n,i,j-1]+u[n,i,j-2])",
        ),
    ] {
        let start = std::time::Instant::now();
        let step = Step::from_text(text).unwrap();
        let set = step.stable_set("C", &Default::default()).unwrap();
        let limit = set.limit();
        println!(
            "{name}: {:?} {:?} {:?} wave {:?} intervals {} undecided {:?} work {:?} {:?}",
            limit.closed_form(),
            limit.decimal(16),
            limit.evidence(),
            limit.critical_wave(),
            set.intervals.len(),
            set.undecided,
            set.work,
            start.elapsed()
        );
    }
}
