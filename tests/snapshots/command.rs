//! Help, verdicts and refusals of the command, word for word.

use assert_cmd::Command;

use crate::golden;

fn output(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::cargo_bin("selfosc").unwrap().args(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// Standard output of a command that does what it is asked.
fn done(arguments: &[&str]) -> String {
    let (status, answer, complaint) = output(arguments);
    assert_eq!((status, complaint.as_str()), (Some(0), ""));
    answer
}

/// Exit status and the complaint; nothing on standard output.
fn refused(arguments: &[&str]) -> String {
    let (status, answer, complaint) = output(arguments);
    assert_eq!(answer, "", "{arguments:?}");
    format!("selfosc {}\nexit status {}\n{complaint}", arguments.join(" "), status.unwrap())
}

macro_rules! helps {
    ($($test:ident $name:literal [$($argument:literal),*];)+) => {
        $(
            #[test]
            fn $test() {
                golden!($name, done(&[$($argument,)* "--help"]));
            }
        )+
    };
}
helps! {
    help "help" [];
    verify_help "verify-help" ["verify"];
    df_help "df-help" ["df"];
    balance_help "balance-help" ["balance"];
    predict_help "predict-help" ["predict"];
    simulate_help "simulate-help" ["simulate"];
    tune_help "tune-help" ["tune"];
    autotune_help "autotune-help" ["autotune"];
    run_help "run-help" ["run"];
    design_help "design-help" ["design"];
}

/// Verdicts and evidence of every claim. The worst margins are left out: they hang on the last bit of the arithmetic.
#[test]
fn verify() {
    let summary = done(&["verify", "--cases", "100"]);
    insta::with_settings!({ filters => [(r"margin \S+", "margin [..]")] }, { golden!("verify", summary) });
}

/// A reader of the paper types its name of a result.
#[test]
fn a_claim_by_the_paper_s_name() {
    let by = |name: &str| done(&["verify", name, "--cases", "10", "--json"]);
    assert_eq!(by("theorem-1"), by("odd-harmonics"));
    assert_eq!(by("Theorem 1"), by("odd-harmonics"));
}

const RELAY: [&str; 4] = ["df", "relay-hysteresis", "--set", "half_width=0.3"];
const AXIS: [&str; 7] = ["predict", "--alpha", "1", "--beta", "1", "--relay", "1"];

#[test]
fn design() {
    let model = ["design", "--alpha", "1", "--beta-quadratic", "0.5", "--delay", "0.1", "--level", "1", "--time", "60"];
    golden!("design", done(&[&model[..], &["--quantum", "0.0175", "--largest-amplitude", "2"]].concat()));
}

/// Written, read again, and refused with one box gone.
#[test]
fn certificates() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    done(&["verify", "--claim", "lemma-1", "--cases", "1", "--certificates", path]);
    golden!("certificates", done(&["verify", "--check", path]));

    let file = folder.path().join("orbit-linear.json");
    let mut certificate: serde_json::Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
    certificate["inequalities"][4]["boxes"].as_array_mut().unwrap().pop();
    std::fs::write(&file, certificate.to_string()).unwrap();
    let (status, answer, complaint) = output(&["verify", "--check", path]);
    assert_eq!((status, complaint.as_str()), (Some(1), ""));
    let refused: Vec<_> = answer.lines().filter(|line| line.contains("refused")).collect();
    assert_eq!(refused.len(), 1, "{answer}");
    assert!(refused[0].starts_with("orbit-linear ") && refused[0].contains("do not make up the domain"), "{refused:?}");

    std::fs::remove_file(&file).unwrap();
    let (status, _, complaint) = output(&["verify", "--check", path]);
    assert_eq!(status, Some(2));
    assert!(complaint.contains("orbit-linear.json") && complaint.contains("--certificates"), "{complaint}");
}

/// A proof of bounds: written with them, checked without a search, refused with one constraint dropped.
#[test]
fn bounds_are_proved_in_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (log, proof) = (path("log.csv"), path("proof.json"));
    let record = ["simulate", "--alpha", "1", "--beta", "0.5", "--relay", "1", "--half-width", "0.3", "--cycles", "5"];
    std::fs::write(&log, done(&[&record[..], &["--hold", "--quantum", "0.02"]].concat())).unwrap();
    let method = ["identify", &log, "--method", "bounded", "--drag", "linear", "--certificate", &proof];
    for (delay, shown) in [("0", "accepted  consistent"), ("0.15", "accepted  refuted")] {
        assert!(done(&[&method[..], &["--delay", delay]].concat()).contains("proof in "));
        assert!(done(&["verify", "--check", &proof]).starts_with(shown));
    }

    let mut certificate: serde_json::Value = serde_json::from_slice(&std::fs::read(&proof).unwrap()).unwrap();
    let steps = certificate["stages"][0]["steps"].as_array_mut().unwrap();
    let rows = steps.iter_mut().rev().find_map(|step| step.get_mut("exclude")?["rows"].as_array_mut());
    rows.filter(|rows| !rows.is_empty()).unwrap().remove(0);
    std::fs::write(&proof, certificate.to_string()).unwrap();
    let (status, answer, _) = output(&["verify", "--check", &proof]);
    assert_eq!(status, Some(1));
    assert!(answer.starts_with("refused   step: "), "{answer}");
}

/// Fewer passes leave wider bounds, which hold nevertheless.
#[test]
fn bounds_within_a_budget() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log.csv").to_str().unwrap().to_owned();
    let record = ["simulate", "--alpha", "1", "--beta", "0.5", "--relay", "1", "--half-width", "0.3", "--cycles", "8"];
    std::fs::write(&path, done(&[&record[..], &["--hold", "--quantum", "0.02"]].concat())).unwrap();
    let method = ["identify", &path, "--method", "bounded", "--drag", "mixed", "--delay", "0", "--json", "--budget"];
    let [little, enough] = ["1", "3000"].map(|budget| {
        let answer: serde_json::Value = serde_json::from_str(&done(&[&method[..], &[budget]].concat())).unwrap();
        let side = |name: &str| -> [f64; 2] { serde_json::from_value(answer["bounded"][name].clone()).unwrap() };
        assert_eq!(answer["bounded"]["verdict"], "consistent");
        ["alpha", "beta", "beta_quadratic"].map(side)
    });
    let method = &method[..method.len() - 2];
    assert!(done(&[method, &["--budget", "1"]].concat()).contains("The budget of one pass was spent"));
    assert!(!done(&[method, &["--budget", "3000"]].concat()).contains("was spent"));
    for ((little, enough), truth) in little.iter().zip(&enough).zip([1.0, 0.5, 0.0]) {
        assert!(little[0] <= enough[0] && enough[0] <= truth && truth <= enough[1] && enough[1] <= little[1]);
        assert!(enough[1] - enough[0] < 0.5 * (little[1] - little[0]), "{little:?}, {enough:?}");
    }
}

/// Two readings damaged: the model is refuted with one granted, and both are named with two.
#[test]
fn bounds_with_readings_in_error() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("damaged.csv").to_str().unwrap().to_owned();
    let record =
        ["simulate", "--alpha", "1.2", "--beta", "0.5", "--relay", "1", "--half-width", "0.4", "--cycles", "5"];
    let log = done(&[&record[..], &["--hold", "--quantum", "0.02"]].concat());
    let damaged = log.lines().enumerate().map(|(line, text)| {
        let fields: Vec<&str> = text.split(',').collect();
        let output = match line {
            40 => "-0.68",
            101 => "0.3",
            _ => fields[1],
        };
        format!("{},{output},{}\n", fields[0], fields[2])
    });
    std::fs::write(&path, damaged.collect::<String>()).unwrap();
    let method = ["identify", &path, "--method", "bounded", "--drag", "linear", "--delay", "0", "--outliers"];
    let answers = ["1", "2", "3"].map(|allowed| {
        // Columns are as wide as the folder's name.
        let answer = done(&[&method[..], &[allowed]].concat()).replace(&path, "damaged.csv");
        let lines: Vec<String> =
            answer.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
        let first = lines.iter().position(|line| line.starts_with("Guaranteed") || line.starts_with("Where")).unwrap();
        format!("--outliers {allowed}\n{}\n", lines[first..].join("\n"))
    });
    golden!("bounded-outliers", answers.join("\n"));
}

fn with(first: &[&'static str], rest: &[&'static str]) -> Vec<&'static str> {
    first.iter().chain(rest).copied().collect()
}

#[test]
fn refusals() {
    let cases = [
        vec!["df", "relays", "--amplitude", "1"],
        vec!["df", "relay-hysteresis", "--amplitude", "1"],
        vec!["df", "relay-hysteresis", "--set", "width=1", "--amplitude", "1"],
        vec!["df", "relay-hysteresis", "--set", "half_width=-1", "--amplitude", "1"],
        vec!["df", "relay-hysteresis", "--set", "half_width=wide", "--amplitude", "1"],
        with(&RELAY, &[]),
        with(&RELAY, &["--amplitude", "0.2"]),
        with(&RELAY, &["--amplitude", "-1"]),
        with(&RELAY, &["--amplitude", "NaN"]),
        with(&RELAY, &["--amplitude", "1", "--bias", "inf"]),
        with(&AXIS, &["--half-width", "-0.2"]),
        with(&AXIS, &["--half-width", "0.2", "--delay", "NaN"]),
        with(&AXIS, &[]),
        vec!["predict", "--alpha", "0", "--relay", "1", "--half-width", "0.2"],
        vec!["balance", "--num", "1", "--den", "0,1", "--nonlinearity", "relay"],
        vec!["balance", "--num", "1,2,3", "--den", "1,1", "--nonlinearity", "relay"],
        vec!["tune", "--alpha", "0", "--bandwidth", "1"],
        vec!["tune", "--alpha", "1", "--bandwidth", "0"],
        vec!["tune", "--alpha", "1", "--beta", "5", "--bandwidth", "1"],
        vec!["tune", "--alpha", "1", "--delay", "1", "--bandwidth", "1"],
        vec!["tune", "--alpha", "1", "--beta", "5", "--delay", "1", "--bandwidth", "2", "--structure", "ipd"],
        vec!["tune", "--alpha", "1", "--bandwidth", "1", "--structure", "pdi"],
        vec!["tune", "--alpha", "1", "--bandwidth", "1", "--alpha-interval", "2,1"],
        vec!["verify", "--claim", "lemma-3"],
        vec!["verify", "--cases", "0"],
        vec!["reproduce", "--only", "fig1"],
    ];
    let complaints = cases.map(|case| refused(&case)).join("\n");
    // The list of claims grows.
    insta::with_settings!({ filters => [(r"the claims are: .*", "the claims are: [..]")] }, {
        golden!("refusals", complaints)
    });
}

const TUNE: [&str; 9] = ["tune", "--alpha", "0.033", "--beta", "0.01", "--delay", "0.2", "--bandwidth", "0.8"];

/// Gains and margins; the poles and the step have digits that hang on the arithmetic, four of them do not.
#[test]
fn tune() {
    let quadratic = done(&with(&TUNE, &["--beta-quadratic", "0.06", "--alpha-interval", "0.031,0.035"]));
    let integral = done(&with(&TUNE, &["--structure", "pid"]));
    golden!("tune", format!("{quadratic}\n{integral}"));
}

/// The document that scripts read: names and kinds, and a few numbers against the text of the command.
#[test]
fn tune_json() {
    let document: serde_json::Value = serde_json::from_str(&done(&with(&TUNE, &["--json"]))).unwrap();
    let keys = |value: &serde_json::Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>().join(" ");
    let parts = ["gains", "margins", "verified"].map(|name| format!("{name}: {}", keys(&document[name])));
    golden!("tune-json", format!("{}\n{}", keys(&document), parts.join("\n")));
    assert!(document["worst_case"].is_null() && document["margins"]["gain"].as_f64().unwrap() > 2.0);
}

/// An interval that the controller does not stabilise is an answer.
#[test]
fn tune_unstable() {
    let (status, answer, complaint) = output(&with(&TUNE, &["--delay-interval", "0.1,2"]));
    assert_eq!((status, complaint.as_str()), (Some(1), ""));
    golden!("tune-unstable", answer);
}

/// The limit that a refusal names is proved at some bandwidth, and 3 % less is not in reach.
#[test]
fn the_named_limit_is_in_reach_and_the_least() {
    let axis: [&str; 9] =
        ["tune", "--alpha", "0.033", "--beta", "0.01", "--delay", "0.2", "--beta-interval", "-0.005,0.02"];
    for (flag, asked, begin, end, less) in [
        ("--ms", "1.05", "allow a sensitivity of ", " (--ms)", 0.97),
        ("--phase-margin", "80", "allow a phase margin of ", " degrees (--phase-margin)", 1.03),
    ] {
        let limit = |number: &str| output(&[&axis[..], &[flag, number]].concat());
        let (status, answer, _) = limit(asked);
        let named = answer.split_once(begin).and_then(|(_, rest)| rest.split_once(end));
        let named = named.unwrap_or_else(|| panic!("{status:?} {answer}")).0;
        assert_eq!(limit(named).0, Some(0), "{flag} {named}: {}", limit(named).1);
        let beyond = less * named.parse::<f64>().unwrap();
        assert_eq!(limit(&beyond.to_string()).0, Some(1), "{flag} {beyond}");
    }
}

/// No limit cycle is an answer: status 1 and the reason on standard output.
#[test]
fn no_limit_cycle() {
    let (status, answer, complaint) = output(&with(&AXIS, &["--half-width", "0.2", "--delta", "1.5"]));
    assert_eq!((status, complaint.as_str()), (Some(1), ""));
    golden!("no-limit-cycle", answer);
}

/// Five lags, each 15 % from the next, oscillate with 12.6 s by harmonic balance, and the search ends undecided: it says what is open,
/// and not that there is none.
#[test]
fn an_undecided_search_is_not_called_none() {
    let five = "4.0455577357079076,15.595537536260636,23.815656071646472,18.008057521093743,6.742381249999999,1.0";
    let (status, answer, _) = output(&["predict", "--num", "1", "--den", five, "--relay", "1", "--half-width", "0.1"]);
    assert_eq!(status, Some(1));
    assert!(answer.starts_with("no oscillation is proved, and some periods are not decided\n"), "{answer}");
    assert!(answer.contains("\nnot decided: periods from "), "{answer}");
}

/// What is to be changed where nothing oscillates, or nothing bounds the answer.
#[test]
fn a_remedy_fits_the_fault() {
    let relay = ["--relay", "1", "--half-width", "0.1"];
    let cases: [(&[&str], &str); 3] = [
        (&["predict", "--num", "1", "--den", "1,0,1"], "not decided: periods above "),
        (&["predict", "--num", "-1", "--den", "1,1"], "change the sign of --num"),
        (&["predict", "--num", "1", "--den", "1,0", "--delay", "0.5", "--relay", "1,0"], "give levels of both signs"),
    ];
    for (case, said) in cases {
        let more = if case.contains(&"--relay") { &relay[2..] } else { &relay[..] };
        let (status, answer, _) = output(&[case, more].concat());
        assert!(status == Some(1) && answer.contains(said) && !answer.contains(" inf"), "{case:?}: {answer}");
    }
    assert!(refused(&["tune", "--alpha", "1", "--beta", "1", "--ms", "1.4"]).contains("nothing bounds the bandwidth"));
    let forced = ["tune", "--alpha", "1", "--delay", "0.3", "--bandwidth", "0.3", "--delta", "0.5", "--limit"];
    assert!(refused(&with(&forced, &["0.4"])).contains("raise the limit (--limit)"));
    assert!(done(&with(&forced, &["0.6"])).contains("under the constant force of 0.5"));
    assert!(done(&["tune", "--alpha", "1", "--beta", "1", "--delay", "0.01", "--ms", "1.4"]).contains("at most 1.39"));
}

/// A plant's pole at s = 0 bounds no range of frequencies.
#[test]
fn rounding_is_not_printed_as_a_number() {
    let (_, answer, _) =
        output(&["balance", "--nonlinearity", "saturation", "--set", "breakpoint=1", "--num", "1", "--den", "1,1,0,0"]);
    assert!(answer.contains("between 1.000e-3 and 1.000e3 rad/s"), "{answer}");
}

/// A gain has its amplitudes, and gains have their characteristic.
#[test]
fn the_other_way_round() {
    let answer = done(&["df", "relay-dead-zone", "--set", "dead_zone=0.5", "--gain", "1", "--json"]);
    let answer: serde_json::Value = serde_json::from_str(&answer).unwrap();
    let found = answer["amplitudes"].as_array().unwrap();
    assert_eq!(found.len(), 2);
    assert!(found.iter().all(|one| (one["p"].as_f64().unwrap() - 1.0).abs() < 1e-12));
    // Zeros of the Bessel function J_1.
    let zeros = done(&["df", "sine", "--gain", "0", "--json"]);
    let zeros: serde_json::Value = serde_json::from_str(&zeros).unwrap();
    for (place, zero) in [3.831_705_970_207_512, 7.015_586_669_815_619].into_iter().enumerate() {
        assert!((zeros["amplitudes"][place]["amplitude"].as_f64().unwrap() - zero).abs() < 1e-9, "{zeros}");
    }
    let (status, answer, _) = output(&["df", "saturation", "--set", "breakpoint=1", "--gain", "3"]);
    assert_eq!((status, answer.contains("no amplitude")), (Some(1), true));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("gains.csv");
    // P of a saturation, 2/pi (asin(b/X) + b/X sqrt(1 - (b/X)^2)) beyond its breakpoint b = 0.7.
    let gain = |x: f64| {
        if x < 0.7 {
            1.0
        } else {
            2.0 / std::f64::consts::PI * ((0.7 / x).asin() + 0.7 / x * (1.0 - (0.7 / x).powi(2)).sqrt())
        }
    };
    let rows: String = [0.3, 0.5, 0.8, 1.1, 1.6, 2.5, 4.0].map(|x| format!("{x},{}\n", gain(x))).concat();
    std::fs::write(&path, format!("amplitude,p\n{rows}")).unwrap();
    let ranked: serde_json::Value =
        serde_json::from_str(&done(&["df", "--fit", path.to_str().unwrap(), "--json"])).unwrap();
    let best: Vec<_> = ranked["fits"].as_array().unwrap().iter().take(3).collect();
    assert!(
        best.iter().any(|fit| fit["nonlinearity"] == "saturation" && fit["residual"].as_f64().unwrap() < 1e-9),
        "{best:?}"
    );
}

/// Every term that `identify` reports takes part in the design, and the constant force in the step.
#[test]
fn every_reported_term_is_tuned_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.json");
    let tuned = |term: &str, value: f64| {
        let text = format!(
            r#"{{"reported": {{"alpha": {{"value": 1}}, "beta": {{"value": 0.5, "low": -0.01, "high": 0.6}}, "trust": "good",
                "memory_s": {{"value": 0.5}}, "delay_s": {{"value": 0.1}}, "{term}": {{"value": {value}}}}}}}"#
        );
        std::fs::write(&path, text).unwrap();
        let (status, answer, complaint) =
            output(&["tune", "--model", path.to_str().unwrap(), "--bandwidth", "0.4", "--json"]);
        assert_eq!((status, complaint.as_str()), (Some(0), ""), "{term}: {answer}");
        serde_json::from_str::<serde_json::Value>(&answer).unwrap()
    };
    let without = tuned("beta_quadratic", 0.0);
    for term in ["beta_cubic", "skew", "coulomb", "memory", "stiffness", "lag_s", "ramp_s", "pause_s", "filter_s"] {
        let with = tuned(term, 0.1);
        // Drag that grows with the speed makes no axis worse than it is at rest, nor does friction.
        let same = with["worst_case"]["met"] == without["worst_case"]["met"];
        assert!(!same || ["beta_cubic", "coulomb"].contains(&term), "{term} changes no margin");
        assert_ne!(with["verified"]["step"], without["verified"]["step"], "{term} changes no step");
    }
    let pushed = tuned("delta", 0.0495);
    let (offset, gain) = (pushed["offset"].as_f64().unwrap(), pushed["gains"]["proportional"].as_f64().unwrap());
    assert!((offset - 0.0495 / gain).abs() < 1e-15);
    assert!((pushed["with_force"]["step"]["final_error"].as_f64().unwrap() / offset - 1.0).abs() < 0.02);
}

/// Drags that make up for each other leave fewer slopes than their box; a covariance of other intervals is refused.
#[test]
fn the_covariance_of_the_drag_is_tuned_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.json");
    let tune = |covariance: &str, more: &[&str]| {
        let drag = |value: f64, std: f64| {
            let (low, high) = (value - 2.0 * std, value + 2.0 * std);
            format!(r#"{{"value": {value}, "combined": {{"std": {std}, "low": {low}, "high": {high}}}}}"#)
        };
        let text = format!(
            r#"{{"reported": {{"alpha": {{"value": 1}}, "beta": {}, "beta_quadratic": {}, "trust": "good",
                "drag_covariance": {covariance}, "delay_s": {{"value": 0.1}}}}}}"#,
            drag(0.4, 0.1),
            drag(0.1, 0.2),
        );
        std::fs::write(&path, text).unwrap();
        let call = ["tune", "--model", path.to_str().unwrap(), "--bandwidth", "0.5", "--top-speed", "1", "--json"];
        output(&[&call, more].concat())
    };
    let margin = |covariance: &str, more: &[&str]| {
        let (status, answer, complaint) = tune(covariance, more);
        assert_eq!((status, complaint.as_str()), (Some(0), ""), "{answer}");
        serde_json::from_str::<serde_json::Value>(&answer).unwrap()["sensitivity"]["met"].as_f64().unwrap()
    };
    let of = |across: f64| format!(r#"{{"combined": [[0.01, {across}, 0], [{across}, 0.04, 0], [0, 0, 0]]}}"#);
    let (box_, together) = (margin("null", &[]), margin(&of(-0.019), &[]));
    assert!(together < box_, "{together} {box_}");
    // An interval given is independent of the rest.
    let given = ["--beta-interval", "0.2,0.6"];
    assert_eq!(margin(&of(-0.019), &given), margin("null", &given));
    for wrong in [
        of(-0.0201),
        of(0.0).replacen("0.01", "0.02", 1),
        of(0.0).replace(", [0, 0, 0]", ""),
        of(0.0).replacen("0.01", "\"a\"", 1),
        r#"{"combined": [[0.01, 0.001, 0], [0.002, 0.04, 0], [0, 0, 0]]}"#.to_owned(),
        r#"{"combined": 1}"#.to_owned(),
    ] {
        let (status, _, complaint) = tune(&wrong, &[]);
        assert!(status == Some(2) && complaint.contains("reported.drag_covariance.combined"), "{wrong}: {complaint}");
    }
}

/// A limit of sensitivity or phase margin holds for every axis, and the gains can be typed in.
#[test]
fn tune_to_a_limit_and_in_a_form() {
    let model = [
        "tune",
        "--alpha",
        "0.033",
        "--beta",
        "0.01",
        "--beta-quadratic",
        "0.06",
        "--delay",
        "0.2",
        "--alpha-interval",
        "0.031,0.035",
    ];
    let json = |more: &[&'static str]| serde_json::from_str::<serde_json::Value>(&done(&with(&model, more))).unwrap();
    assert!(json(&["--ms", "1.4", "--json"])["sensitivity"]["proved_upper"].as_f64().unwrap() <= 1.4);
    let least = json(&["--phase-margin", "50", "--json"])["worst_case"]["at_least"]["phase_rad"].as_f64().unwrap();
    assert!(least.to_degrees() >= 49.0);
    let forms = ["ardusub", "px4", "c"].map(|form| done(&with(&model, &["--bandwidth", "0.8", "--format", form])));
    golden!("tune-forms", forms.join("\n"));
    // Each names a remedy that it takes.
    let against = |form| done(&with(&model, &["--bandwidth", "0.8", "--delta", "0.004", "--format", form]));
    assert!(against("ardusub").contains("choose --structure pid against it"));
    assert!(against("px4").contains("no integral against it") && !against("px4").contains("--structure"));
    // ArduSub's cascade is the same controller.
    let pid = json(&["--bandwidth", "0.8", "--structure", "pid", "--json"]);
    let text = done(&with(&model, &["--bandwidth", "0.8", "--structure", "pid", "--format", "ardusub"]));
    let value = |name: &str| {
        let line = text.lines().find(|line| line.starts_with(name)).unwrap();
        line.rsplit(' ').next().unwrap().parse::<f64>().unwrap()
    };
    let (angle, rate, integral) = (value("ATC_ANG_YAW_P"), value("ATC_RAT_YAW_P"), value("ATC_RAT_YAW_I"));
    for (made, name) in
        [(angle * rate + integral, "proportional"), (angle * integral, "integral"), (rate, "derivative")]
    {
        assert!((made / pid["gains"][name].as_f64().unwrap() - 1.0).abs() < 1e-2, "{name}");
    }
}

/// Where the value of the drag leaves some axis of its interval unstable, gains are placed for the least slope, and say so.
#[test]
fn an_uncertain_drag_is_placed_for() {
    let call = ["tune", "--alpha=1", "--beta=0", "--beta-interval=-1.2,1.2", "--delay=0.25", "--json"];
    let slope = |bandwidth: &str| {
        let document: serde_json::Value = serde_json::from_str(&done(&[&call[..], &[bandwidth]].concat())).unwrap();
        assert_eq!(document["worst_case"]["proved"], true);
        document["placed_for_slope"].as_f64().unwrap()
    };
    assert_eq!(slope("--bandwidth=0.7"), 0.0);
    assert_eq!(slope("--bandwidth=0.3"), -1.2);
    assert!(done(&[&call[..5], &["--bandwidth=0.3"]].concat()).contains("placed for a drag of slope -1.2"));

    // A record does not tell the slope at rest: an identified axis of strong drag has gains below the bandwidth of its drag.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.json");
    let drag = r#"{"value": 2, "combined": {"std": 0.1, "low": 1.8, "high": 2.2}}"#;
    let model = format!(
        r#"{{"reported": {{"alpha": {{"value": 1}}, "beta": {drag}, "trust": "good", "delay_s": {{"value": 0.9}}}}}}"#
    );
    std::fs::write(&path, model).unwrap();
    let identified = done(&["tune", "--model", path.to_str().unwrap(), "--bandwidth=0.2"]);
    assert!(identified.contains("placed for a drag of slope 0 "), "{identified}");

    // A limit out of reach names one that is within.
    for (flag, asked, words) in [("--ms", "1.2", "a sensitivity of "), ("--phase-margin", "75", "a phase margin of ")] {
        let limited = |limit: &str| {
            output(&["tune", "--alpha=1", "--beta=0", "--beta-interval=-0.4,0.4", "--delay=0.25", flag, limit])
        };
        let (status, refused, _) = limited(asked);
        assert_eq!(status, Some(1), "{refused}");
        let (_, named) = refused.split_once(words).unwrap();
        assert_eq!(limited(named.split(' ').next().unwrap()).0, Some(0), "{refused}");
    }
    let (status, _, complaint) = output(&["tune", "--alpha=1", "--beta=2", "--delay=0.9", "--bandwidth=0.2"]);
    assert!(status == Some(2) && complaint.contains("is below"), "{complaint}");
}
