function t(e){return e.clientWidth/(e.getBoundingClientRect().width||1)}function i(e,{clientX:n}){return(n-e.getBoundingClientRect().left)*t(e)}export{t as a,i as b};
