use selfosc::claims::method_bias::DragLaw;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::theorem::THEOREMS;
use selfosc::orbit::{certify, limit_cycle};
use selfosc::plant::DragAxis;

#[test]
fn explore() {
    for law in [DragLaw::Linear, DragLaw::Quadratic] {
        for (a, b) in [(0.0, 1e-6), (1.0, 1.0), (10.0, 10.0), (0.0, 1.0), (0.0, 10.0), (1.0, 10.0)] {
            println!("{law:?} {a} {b} {:?}", law.error_over(a, b));
        }
    }
    for t in THEOREMS {
        for i in t.inequalities {
            let s = std::time::Instant::now();
            match i.prove(200000) {
                selfosc::numeric::inequality::Search::Proved(p) => {
                    let d = s.elapsed();
                    let s = std::time::Instant::now();
                    let c = i.check(&p);
                    println!(
                        "{} {} bound {} boxes {} in {:?} check {:?} {:?}",
                        t.id,
                        i.id,
                        p.bound,
                        p.boxes.len(),
                        d,
                        s.elapsed(),
                        c
                    );
                }
                o => println!("{} {} {o:?}", t.id, i.id),
            }
        }
    }
    for (l, q, d, td, xa) in [
        (0.4, 0., 0., 0., 0.3),
        (0., 0.5, 0., 0., 0.3),
        (0.2, 0.3, 0., 0., 0.3),
        (0.2, 0.3, 0.4, 0., 0.3),
        (2e-4, 3e-4, 0.4, 0., 0.3),
        (20., 30., 0.4, 0., 0.3),
        (0.2, 0.3, 0.4, 0.5, 0.3),
        (0.2, 0.3, 0.4, 0.5, 0.0),
        (0., 1., 0., 0., 10.),
        (0., 1., 0.95, 0., 10.),
        (1e-6, 0., 0., 0., 0.3),
    ] {
        let axis = DragAxis::mixed(1.0, l, q).unwrap().with_disturbance(d).unwrap().with_delay_s(td).unwrap();
        let relay = RelayHysteresis::new(1.0, xa, 0.0).unwrap();
        let s = std::time::Instant::now();
        let c = certify(&axis, &relay);
        let e = s.elapsed();
        let f = limit_cycle(&axis, &relay).unwrap();
        match c {
            Ok(c) => println!(
                "{l} {q} {d} {td} {xa}: {e:?} amp {} in {} w {:e} T {} in {} m {} {}",
                f.amplitude,
                c.enclosure.amplitude,
                c.enclosure.amplitude.width(),
                f.period_s,
                c.enclosure.period_s,
                f.multiplier,
                c.enclosure.multiplier
            ),
            Err(e) => println!("{l} {q} {d} {td} {xa}: {e}"),
        }
    }
}
