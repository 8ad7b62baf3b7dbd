use selfosc::paper::*;
fn main(){
 for d in [false,true]{ let t=table3::formulas(d).unwrap(); for e in [t.parameters.alpha,t.parameters.beta,t.parameters.beta_quadratic,t.parameters.disturbance,t.disturbance_from_times]{println!("{e}\n   {}",e.latex());}}
 for (a,t) in table2::formulas(){println!("{a:?} {} | {} | {}",t.alpha,t.minus_beta,t.delta);}
 let p=table4::PrintedTable::compiled_in().unwrap(); let t=table4::table4(&p).unwrap();
 println!("{:?} {:?} {} {}",t.mean,t.std_percent,t.level_offset,t.level_offset_residual_percent);
 let s=std::time::Instant::now();
 let a=audit::audit(&p,&t).unwrap(); println!("{:?}",s.elapsed());
 for g in &a {println!("{} {}/{} {}",g.name,g.agreeing(),g.items.len(),g.largest_difference()); if g.items.len()<19||g.name.starts_with("X_m"){for i in &g.items{println!("    {i:?}");}}}
}
