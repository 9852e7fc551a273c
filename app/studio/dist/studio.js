var qs={panel:"pose",robot:"panda",draft:null,base:null,tip:null,target:null,inverse:null,writing:{part:"transforms",notation:"short",symbolic:!0},degrees:!1,frames:!1,axes:!1,names:!1,dh:!1,options:{}};function Pd(s){return{...s,positions:{},model:null,meshes:0,loading:!1,failure:null,table:null,joint:null,unit:.1,theme:"auto",dark:!1}}function sa(s,t,e){return e.find(i=>i===s.options[t])??e[0]}function ra(s,t,e){let{[t]:i,...n}=s.options;return{options:e===null?n:{...n,[t]:e}}}var Zn={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},Jn={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},vf=0,qh=1,bf=2;var Mo=1,Sf=2,wr=3,cn=0,ui=1,si=2,Ps=0,Mr=1,jh=2,Yh=3,$h=4,wf=5;var Is=100,Mf=101,Tf=102,Af=103,Ef=104,Rf=200,Cf=201,Pf=202,If=203,Zh=204,Jh=205,Lf=206,Nf=207,Df=208,zf=209,kf=210,Ff=211,Of=212,Uf=213,Bf=214,Da=0,za=1,ka=2,lr=3,Fa=4,Oa=5,Ua=6,Ba=7,To=0,Vf=1,Hf=2,hn=0,Kh=1,Qh=2,tu=3,eu=4,iu=5,nu=6,su=7,Ih="attached",Gf="detached",ru=300,Ls=301,Tr=302,ol=303,al=304,Mn=1e3,ci=1001,Va=1002,He=1003,Wf=1004;var Ao=1005;var Ve=1006,ll=1007;var ki=1008;var yi=1009,ou=1010,au=1011,Ar=1012,cl=1013,Zi=1014,Fi=1015,Ji=1016,hl=1017,ul=1018,Ns=1020,lu=35902,cu=35899,hu=1021,uu=1022,Oi=1023,Tn=1026,Ln=1027,du=1028,dl=1029,Kn=1030,fl=1031;var pl=1033,Eo=33776,Ro=33777,Co=33778,Po=33779,ml=35840,gl=35841,xl=35842,yl=35843,_l=36196,vl=37492,bl=37496,Sl=37488,wl=37489,Io=37490,Ml=37491,Tl=37808,Al=37809,El=37810,Rl=37811,Cl=37812,Pl=37813,Il=37814,Ll=37815,Nl=37816,Dl=37817,zl=37818,kl=37819,Fl=37820,Ol=37821,Ul=36492,Bl=36494,Vl=36495,Hl=36283,Gl=36284,Lo=36285,Wl=36286;var xs=2300,Ha=2301,La=2302,Qr=2303,Lh=2400,Nh=2401,Dh=2402,Xf=2500;var qf=3200;var No=0,jf=1,Nn="",oe="srgb",to="srgb-linear",eo="linear",ne="srgb";var Na=7680;var Yf=519,$f=512,Zf=513,Jf=514,fu=515,Kf=516,Qf=517,pu=518,mu=519,tp=35044;var gu="300 es",Di=2e3,cr=2001;function Yg(s){for(let t=s.length-1;t>=0;--t)if(s[t]>=65535)return!0;return!1}function $g(s){return ArrayBuffer.isView(s)&&!(s instanceof DataView)}function hr(s){return document.createElementNS("http://www.w3.org/1999/xhtml",s)}function ep(){let s=hr("canvas");return s.style.display="block",s}var Id={},ur=null;function xu(...s){let t="THREE."+s.shift();ur?ur("log",t,...s):console.log(t,...s)}function ip(s){let t=s[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=s[1];e&&e.isStackTrace?s[0]+=" "+e.getLocation():s[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return s}function Pt(...s){s=ip(s);let t="THREE."+s.shift();if(ur)ur("warn",t,...s);else{let e=s[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...s)}}function kt(...s){s=ip(s);let t="THREE."+s.shift();if(ur)ur("error",t,...s);else{let e=s[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...s)}}function Zr(...s){let t=s.join(" ");t in Id||(Id[t]=!0,Pt(...s))}function np(s,t,e){return new Promise(function(i,n){function r(){switch(s.clientWaitSync(t,s.SYNC_FLUSH_COMMANDS_BIT,0)){case s.WAIT_FAILED:n();break;case s.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:i()}}setTimeout(r,e)})}var sp={[Da]:Da,[ka]:Ua,[Fa]:Fa,[lr]:Oa,[za]:za,[Ua]:ka,[Ba]:Ba,[Oa]:lr},ji=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[t]===void 0&&(i[t]=[]),i[t].indexOf(e)===-1&&i[t].push(e)}hasEventListener(t,e){let i=this._listeners;return i===void 0?!1:i[t]!==void 0&&i[t].indexOf(e)!==-1}removeEventListener(t,e){let i=this._listeners;if(i===void 0)return;let n=i[t];if(n!==void 0){let r=n.indexOf(e);r!==-1&&n.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let i=e[t.type];if(i!==void 0){t.target=this;let n=i.slice(0);for(let r=0,o=n.length;r<o;r++)n[r].call(this,t);t.target=null}}},Je=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Ld=1234567,Jr=Math.PI/180,ys=180/Math.PI;function Qn(){let s=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(Je[s&255]+Je[s>>8&255]+Je[s>>16&255]+Je[s>>24&255]+"-"+Je[t&255]+Je[t>>8&255]+"-"+Je[t>>16&15|64]+Je[t>>24&255]+"-"+Je[e&63|128]+Je[e>>8&255]+"-"+Je[e>>16&255]+Je[e>>24&255]+Je[i&255]+Je[i>>8&255]+Je[i>>16&255]+Je[i>>24&255]).toLowerCase()}function jt(s,t,e){return Math.max(t,Math.min(e,s))}function yu(s,t){return(s%t+t)%t}function Zg(s,t,e,i,n){return i+(s-t)*(n-i)/(e-t)}function Jg(s,t,e){return s!==t?(e-s)/(t-s):0}function Kr(s,t,e){return(1-e)*s+e*t}function Kg(s,t,e,i){return Kr(s,t,1-Math.exp(-e*i))}function Qg(s,t=1){return t-Math.abs(yu(s,t*2)-t)}function t0(s,t,e){return s<=t?0:s>=e?1:(s=(s-t)/(e-t),s*s*(3-2*s))}function e0(s,t,e){return s<=t?0:s>=e?1:(s=(s-t)/(e-t),s*s*s*(s*(s*6-15)+10))}function i0(s,t){return s+Math.floor(Math.random()*(t-s+1))}function n0(s,t){return s+Math.random()*(t-s)}function s0(s){return s*(.5-Math.random())}function r0(s){s!==void 0&&(Ld=s);let t=Ld+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function o0(s){return s*Jr}function a0(s){return s*ys}function l0(s){return s>0&&Number.isInteger(s)&&2**Math.round(Math.log2(s))===s}function c0(s){return Math.pow(2,Math.ceil(Math.log(s)/Math.LN2))}function _u(s){return Math.pow(2,Math.floor(Math.log(s)/Math.LN2))}function h0(s,t,e,i,n){let r=Math.cos,o=Math.sin,a=r(e/2),l=o(e/2),c=r((t+i)/2),h=o((t+i)/2),u=r((t-i)/2),d=o((t-i)/2),f=r((i-t)/2),m=o((i-t)/2);switch(n){case"XYX":s.set(a*h,l*u,l*d,a*c);break;case"YZY":s.set(l*d,a*h,l*u,a*c);break;case"ZXZ":s.set(l*u,l*d,a*h,a*c);break;case"XZX":s.set(a*h,l*m,l*f,a*c);break;case"YXY":s.set(l*f,a*h,l*m,a*c);break;case"ZYZ":s.set(l*m,l*f,a*h,a*c);break;default:Pt("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+n)}}function vu(s){switch(s.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function rp(s,t){if(t.constructor===Float32Array)return s;let e=vu(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(s/e,-1)}function op(s,t){if(t.constructor===Float32Array)return s;let e=vu(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(s*e)}var _i={DEG2RAD:Jr,RAD2DEG:ys,generateUUID:Qn,clamp:jt,euclideanModulo:yu,mapLinear:Zg,inverseLerp:Jg,lerp:Kr,damp:Kg,pingpong:Qg,smoothstep:t0,smootherstep:e0,randInt:i0,randFloat:n0,randFloatSpread:s0,seededRandom:r0,degToRad:o0,radToDeg:a0,isPowerOfTwo:l0,ceilPowerOfTwo:c0,floorPowerOfTwo:_u,setQuaternionFromProperEuler:h0,normalize:op,denormalize:rp},Rt=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,i=this.y,n=t.elements;return this.x=n[0]*e+n[3]*i+n[6],this.y=n[1]*e+n[4]*i+n[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=jt(this.x,t.x,e.x),this.y=jt(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=jt(this.x,t,e),this.y=jt(this.y,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(jt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(jt(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y;return e*e+i*i}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let i=Math.cos(e),n=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*i-o*n+t.x,this.y=r*n+o*i+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},Wt=class{constructor(t=0,e=0,i=0,n=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=i,this._w=n}static slerpFlat(t,e,i,n,r,o,a){let l=i[n+0],c=i[n+1],h=i[n+2],u=i[n+3],d=r[o+0],f=r[o+1],m=r[o+2],x=r[o+3];if(u!==x||l!==d||c!==f||h!==m){let p=l*d+c*f+h*m+u*x;p<0&&(d=-d,f=-f,m=-m,x=-x,p=-p);let g=1-a;if(p<.9995){let _=Math.acos(p),b=Math.sin(_);g=Math.sin(g*_)/b,a=Math.sin(a*_)/b,l=l*g+d*a,c=c*g+f*a,h=h*g+m*a,u=u*g+x*a}else{l=l*g+d*a,c=c*g+f*a,h=h*g+m*a,u=u*g+x*a;let _=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=_,c*=_,h*=_,u*=_}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,i,n,r,o){let a=i[n],l=i[n+1],c=i[n+2],h=i[n+3],u=r[o],d=r[o+1],f=r[o+2],m=r[o+3];return t[e]=a*m+h*u+l*f-c*d,t[e+1]=l*m+h*d+c*u-a*f,t[e+2]=c*m+h*f+a*d-l*u,t[e+3]=h*m-a*u-l*d-c*f,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,i,n){return this._x=t,this._y=e,this._z=i,this._w=n,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let i=t._x,n=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(i/2),h=a(n/2),u=a(r/2),d=l(i/2),f=l(n/2),m=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u-d*f*m;break;case"YXZ":this._x=d*h*u+c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u+d*f*m;break;case"ZXY":this._x=d*h*u-c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u-d*f*m;break;case"ZYX":this._x=d*h*u-c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u+d*f*m;break;case"YZX":this._x=d*h*u+c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u-d*f*m;break;case"XZY":this._x=d*h*u-c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u+d*f*m;break;default:Pt("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let i=e/2,n=Math.sin(i);return this._x=t.x*n,this._y=t.y*n,this._z=t.z*n,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,i=e[0],n=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],h=e[6],u=e[10],d=i+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-n)*f}else if(i>a&&i>u){let f=2*Math.sqrt(1+i-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(n+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-i-u);this._w=(r-c)/f,this._x=(n+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-i-a);this._w=(o-n)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let i=t.dot(e)+1;return i<1e-8?(i=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=i):(this._x=0,this._y=-t.z,this._z=t.y,this._w=i)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=i),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(jt(this.dot(t),-1,1)))}rotateTowards(t,e){let i=this.angleTo(t);if(i===0)return this;let n=Math.min(1,e/i);return this.slerp(t,n),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let i=t._x,n=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,h=e._w;return this._x=i*h+o*a+n*c-r*l,this._y=n*h+o*l+r*a-i*c,this._z=r*h+o*c+i*l-n*a,this._w=o*h-i*a-n*l-r*c,this._onChangeCallback(),this}slerp(t,e){let i=t._x,n=t._y,r=t._z,o=t._w,a=this.dot(t);a<0&&(i=-i,n=-n,r=-r,o=-o,a=-a);let l=1-e;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,e=Math.sin(e*c)/h,this._x=this._x*l+i*e,this._y=this._y*l+n*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this._onChangeCallback()}else this._x=this._x*l+i*e,this._y=this._y*l+n*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this.normalize();return this}slerpQuaternions(t,e,i){return this.copy(t).slerp(e,i)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),i=Math.random(),n=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(n*Math.sin(t),n*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},C=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,i=0){this.x=t,this.y=e,this.z=i}set(t,e,i){return i===void 0&&(i=this.z),this.x=t,this.y=e,this.z=i,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(Nd.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(Nd.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,i=this.y,n=this.z,r=t.elements;return this.x=r[0]*e+r[3]*i+r[6]*n,this.y=r[1]*e+r[4]*i+r[7]*n,this.z=r[2]*e+r[5]*i+r[8]*n,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,i=this.y,n=this.z,r=t.elements,o=1/(r[3]*e+r[7]*i+r[11]*n+r[15]);return this.x=(r[0]*e+r[4]*i+r[8]*n+r[12])*o,this.y=(r[1]*e+r[5]*i+r[9]*n+r[13])*o,this.z=(r[2]*e+r[6]*i+r[10]*n+r[14])*o,this}applyQuaternion(t){let e=this.x,i=this.y,n=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*n-a*i),h=2*(a*e-r*n),u=2*(r*i-o*e);return this.x=e+l*c+o*u-a*h,this.y=i+l*h+a*c-r*u,this.z=n+l*u+r*h-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,i=this.y,n=this.z,r=t.elements;return this.x=r[0]*e+r[4]*i+r[8]*n,this.y=r[1]*e+r[5]*i+r[9]*n,this.z=r[2]*e+r[6]*i+r[10]*n,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=jt(this.x,t.x,e.x),this.y=jt(this.y,t.y,e.y),this.z=jt(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=jt(this.x,t,e),this.y=jt(this.y,t,e),this.z=jt(this.z,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(jt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let i=t.x,n=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=n*l-r*a,this.y=r*o-i*l,this.z=i*a-n*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let i=t.dot(this)/e;return this.copy(t).multiplyScalar(i)}projectOnPlane(t){return lh.copy(this).projectOnVector(t),this.sub(lh)}reflect(t){return this.sub(lh.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(jt(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y,n=this.z-t.z;return e*e+i*i+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,i){let n=Math.sin(e)*t;return this.x=n*Math.sin(i),this.y=Math.cos(e)*t,this.z=n*Math.cos(i),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,i){return this.x=t*Math.sin(e),this.y=i,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),i=this.setFromMatrixColumn(t,1).length(),n=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=i,this.z=n,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,i=Math.sqrt(1-e*e);return this.x=i*Math.cos(t),this.y=e,this.z=i*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},lh=new C,Nd=new Wt,Ot=class{static{this.prototype.isMatrix3=!0}constructor(t,e,i,n,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,i,n,r,o,a,l,c)}set(t,e,i,n,r,o,a,l,c){let h=this.elements;return h[0]=t,h[1]=n,h[2]=a,h[3]=e,h[4]=r,h[5]=l,h[6]=i,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],this}extractBasis(t,e,i){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,n=e.elements,r=this.elements,o=i[0],a=i[3],l=i[6],c=i[1],h=i[4],u=i[7],d=i[2],f=i[5],m=i[8],x=n[0],p=n[3],g=n[6],_=n[1],b=n[4],y=n[7],M=n[2],S=n[5],v=n[8];return r[0]=o*x+a*_+l*M,r[3]=o*p+a*b+l*S,r[6]=o*g+a*y+l*v,r[1]=c*x+h*_+u*M,r[4]=c*p+h*b+u*S,r[7]=c*g+h*y+u*v,r[2]=d*x+f*_+m*M,r[5]=d*p+f*b+m*S,r[8]=d*g+f*y+m*v,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[1],n=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8];return e*o*h-e*a*c-i*r*h+i*a*l+n*r*c-n*o*l}invert(){let t=this.elements,e=t[0],i=t[1],n=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,m=e*u+i*d+n*f;if(m===0)return this.set(0,0,0,0,0,0,0,0,0);let x=1/m;return t[0]=u*x,t[1]=(n*c-h*i)*x,t[2]=(a*i-n*o)*x,t[3]=d*x,t[4]=(h*e-n*l)*x,t[5]=(n*r-a*e)*x,t[6]=f*x,t[7]=(i*l-c*e)*x,t[8]=(o*e-i*r)*x,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,i,n,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(i*l,i*c,-i*(l*o+c*a)+o+t,-n*c,n*l,-n*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return Zr("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(ch.makeScale(t,e)),this}rotate(t){return Zr("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(ch.makeRotation(-t)),this}translate(t,e){return Zr("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(ch.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,i,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,i=t.elements;for(let n=0;n<9;n++)if(e[n]!==i[n])return!1;return!0}fromArray(t,e=0){for(let i=0;i<9;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t}clone(){return new this.constructor().fromArray(this.elements)}},ch=new Ot,Dd=new Ot().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),zd=new Ot().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function u0(){let s={enabled:!0,workingColorSpace:to,spaces:{},convert:function(n,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===ne&&(n.r=wn(n.r),n.g=wn(n.g),n.b=wn(n.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(n.applyMatrix3(this.spaces[r].toXYZ),n.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===ne&&(n.r=or(n.r),n.g=or(n.g),n.b=or(n.b))),n},workingToColorSpace:function(n,r){return this.convert(n,this.workingColorSpace,r)},colorSpaceToWorking:function(n,r){return this.convert(n,r,this.workingColorSpace)},getPrimaries:function(n){return this.spaces[n].primaries},getTransfer:function(n){return n===Nn?eo:this.spaces[n].transfer},getToneMappingMode:function(n){return this.spaces[n].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(n,r=this.workingColorSpace){return n.fromArray(this.spaces[r].luminanceCoefficients)},define:function(n){Object.assign(this.spaces,n)},_getMatrix:function(n,r,o){return n.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(n){return this.spaces[n].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(n=this.workingColorSpace){return this.spaces[n].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],i=[.3127,.329];return s.define({[to]:{primaries:t,whitePoint:i,transfer:eo,toXYZ:Dd,fromXYZ:zd,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:oe},outputColorSpaceConfig:{drawingBufferColorSpace:oe}},[oe]:{primaries:t,whitePoint:i,transfer:ne,toXYZ:Dd,fromXYZ:zd,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:oe}}}),s}var Ht=u0();function wn(s){return s<.04045?s*.0773993808:Math.pow(s*.9478672986+.0521327014,2.4)}function or(s){return s<.0031308?s*12.92:1.055*Math.pow(s,.41666)-.055}var js,Ga=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let i;if(t instanceof HTMLCanvasElement)i=t;else{js===void 0&&(js=hr("canvas")),js.width=t.width,js.height=t.height;let n=js.getContext("2d");t instanceof ImageData?n.putImageData(t,0,0):n.drawImage(t,0,0,t.width,t.height),i=js}return i.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=hr("canvas");e.width=t.width,e.height=t.height;let i=e.getContext("2d");i.drawImage(t,0,0,t.width,t.height);let n=i.getImageData(0,0,t.width,t.height),r=n.data;for(let o=0;o<r.length;o++)r[o]=wn(r[o]/255)*255;return i.putImageData(n,0,0),e}else if(t.data){let e=t.data.slice(0);for(let i=0;i<e.length;i++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[i]=Math.floor(wn(e[i]/255)*255):e[i]=wn(e[i]);return{data:e,width:t.width,height:t.height}}else return Pt("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},d0=0,dr=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:d0++}),this.uuid=Qn(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let i={uuid:this.uuid,url:""},n=this.data;if(n!==null){let r;if(Array.isArray(n)){r=[];for(let o=0,a=n.length;o<a;o++)n[o].isDataTexture?r.push(hh(n[o].image)):r.push(hh(n[o]))}else r=hh(n);i.url=r}return e||(t.images[this.uuid]=i),i}};function hh(s){return typeof HTMLImageElement<"u"&&s instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&s instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&s instanceof ImageBitmap?Ga.getDataURL(s):s.data?{data:Array.from(s.data),width:s.width,height:s.height,type:s.data.constructor.name}:(Pt("Texture: Unable to serialize Texture."),{})}var f0=0,uh=new C,hi=class s extends ji{constructor(t=s.DEFAULT_IMAGE,e=s.DEFAULT_MAPPING,i=ci,n=ci,r=Ve,o=ki,a=Oi,l=yi,c=s.DEFAULT_ANISOTROPY,h=Nn){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:f0++}),this.uuid=Qn(),this.name="",this.source=new dr(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=i,this.wrapT=n,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new Rt(0,0),this.repeat=new Rt(1,1),this.center=new Rt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Ot,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(uh).x}get height(){return this.source.getSize(uh).y}get depth(){return this.source.getSize(uh).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let i=t[e];if(i===void 0){Pt(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let n=this[e];if(n===void 0){Pt(`Texture.setValues(): property '${e}' does not exist.`);continue}n&&i&&n.isVector2&&i.isVector2||n&&i&&n.isVector3&&i.isVector3||n&&i&&n.isMatrix3&&i.isMatrix3?n.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),e||(t.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==ru)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Mn:t.x=t.x-Math.floor(t.x);break;case ci:t.x=t.x<0?0:1;break;case Va:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Mn:t.y=t.y-Math.floor(t.y);break;case ci:t.y=t.y<0?0:1;break;case Va:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};hi.DEFAULT_IMAGE=null;hi.DEFAULT_MAPPING=ru;hi.DEFAULT_ANISOTROPY=1;var ae=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,i=0,n=1){this.x=t,this.y=e,this.z=i,this.w=n}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,i,n){return this.x=t,this.y=e,this.z=i,this.w=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,i=this.y,n=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*i+o[8]*n+o[12]*r,this.y=o[1]*e+o[5]*i+o[9]*n+o[13]*r,this.z=o[2]*e+o[6]*i+o[10]*n+o[14]*r,this.w=o[3]*e+o[7]*i+o[11]*n+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,i,n,r,l=t.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],m=l[9],x=l[2],p=l[6],g=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-x)<.01&&Math.abs(m-p)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+x)<.1&&Math.abs(m+p)<.1&&Math.abs(c+f+g-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let b=(c+1)/2,y=(f+1)/2,M=(g+1)/2,S=(h+d)/4,v=(u+x)/4,w=(m+p)/4;return b>y&&b>M?b<.01?(i=0,n=.707106781,r=.707106781):(i=Math.sqrt(b),n=S/i,r=v/i):y>M?y<.01?(i=.707106781,n=0,r=.707106781):(n=Math.sqrt(y),i=S/n,r=w/n):M<.01?(i=.707106781,n=.707106781,r=0):(r=Math.sqrt(M),i=v/r,n=w/r),this.set(i,n,r,e),this}let _=Math.sqrt((p-m)*(p-m)+(u-x)*(u-x)+(d-h)*(d-h));return Math.abs(_)<.001&&(_=1),this.x=(p-m)/_,this.y=(u-x)/_,this.z=(d-h)/_,this.w=Math.acos((c+f+g-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=jt(this.x,t.x,e.x),this.y=jt(this.y,t.y,e.y),this.z=jt(this.z,t.z,e.z),this.w=jt(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=jt(this.x,t,e),this.y=jt(this.y,t,e),this.z=jt(this.z,t,e),this.w=jt(this.w,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(jt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this.w=t.w+(e.w-t.w)*i,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Wa=class extends ji{constructor(t=1,e=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Ve,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=i.depth,this.scissor=new ae(0,0,t,e),this.scissorTest=!1,this.viewport=new ae(0,0,t,e),this.textures=[];let n=i.count;for(let r=0;r<n;r++)this.textures[r]=new hi({width:t,height:e,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:Ve,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,i=1){if(this.width!==t||this.height!==e||this.depth!==i){this.width=t,this.height=e,this.depth=i;for(let n=0,r=this.textures.length;n<r;n++)this.textures[n].image.width=t,this.textures[n].image.height=e,this.textures[n].image.depth=i,this.textures[n].isData3DTexture!==!0&&(this.textures[n].isArrayTexture=this.textures[n].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,i=t.textures.length;e<i;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let n=Object.assign({},t.textures[e].image);this.textures[e].source=new dr(n)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Ri=class extends Wa{constructor(t=1,e=1,i={}){super(t,e,i),this.isWebGLRenderTarget=!0}},io=class extends hi{constructor(t=null,e=1,i=1,n=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:i,depth:n},this.magFilter=He,this.minFilter=He,this.wrapR=ci,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var Xa=class extends hi{constructor(t=null,e=1,i=1,n=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:i,depth:n},this.magFilter=He,this.minFilter=He,this.wrapR=ci,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var wt=class s{static{this.prototype.isMatrix4=!0}constructor(t,e,i,n,r,o,a,l,c,h,u,d,f,m,x,p){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,i,n,r,o,a,l,c,h,u,d,f,m,x,p)}set(t,e,i,n,r,o,a,l,c,h,u,d,f,m,x,p){let g=this.elements;return g[0]=t,g[4]=e,g[8]=i,g[12]=n,g[1]=r,g[5]=o,g[9]=a,g[13]=l,g[2]=c,g[6]=h,g[10]=u,g[14]=d,g[3]=f,g[7]=m,g[11]=x,g[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new s().fromArray(this.elements)}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],e[9]=i[9],e[10]=i[10],e[11]=i[11],e[12]=i[12],e[13]=i[13],e[14]=i[14],e[15]=i[15],this}copyPosition(t){let e=this.elements,i=t.elements;return e[12]=i[12],e[13]=i[13],e[14]=i[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,i){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),i.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(t,e,i){return this.set(t.x,e.x,i.x,0,t.y,e.y,i.y,0,t.z,e.z,i.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,i=t.elements,n=1/Ys.setFromMatrixColumn(t,0).length(),r=1/Ys.setFromMatrixColumn(t,1).length(),o=1/Ys.setFromMatrixColumn(t,2).length();return e[0]=i[0]*n,e[1]=i[1]*n,e[2]=i[2]*n,e[3]=0,e[4]=i[4]*r,e[5]=i[5]*r,e[6]=i[6]*r,e[7]=0,e[8]=i[8]*o,e[9]=i[9]*o,e[10]=i[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,i=t.x,n=t.y,r=t.z,o=Math.cos(i),a=Math.sin(i),l=Math.cos(n),c=Math.sin(n),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let d=o*h,f=o*u,m=a*h,x=a*u;e[0]=l*h,e[4]=-l*u,e[8]=c,e[1]=f+m*c,e[5]=d-x*c,e[9]=-a*l,e[2]=x-d*c,e[6]=m+f*c,e[10]=o*l}else if(t.order==="YXZ"){let d=l*h,f=l*u,m=c*h,x=c*u;e[0]=d+x*a,e[4]=m*a-f,e[8]=o*c,e[1]=o*u,e[5]=o*h,e[9]=-a,e[2]=f*a-m,e[6]=x+d*a,e[10]=o*l}else if(t.order==="ZXY"){let d=l*h,f=l*u,m=c*h,x=c*u;e[0]=d-x*a,e[4]=-o*u,e[8]=m+f*a,e[1]=f+m*a,e[5]=o*h,e[9]=x-d*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){let d=o*h,f=o*u,m=a*h,x=a*u;e[0]=l*h,e[4]=m*c-f,e[8]=d*c+x,e[1]=l*u,e[5]=x*c+d,e[9]=f*c-m,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){let d=o*l,f=o*c,m=a*l,x=a*c;e[0]=l*h,e[4]=x-d*u,e[8]=m*u+f,e[1]=u,e[5]=o*h,e[9]=-a*h,e[2]=-c*h,e[6]=f*u+m,e[10]=d-x*u}else if(t.order==="XZY"){let d=o*l,f=o*c,m=a*l,x=a*c;e[0]=l*h,e[4]=-u,e[8]=c*h,e[1]=d*u+x,e[5]=o*h,e[9]=f*u-m,e[2]=m*u-f,e[6]=a*h,e[10]=x*u+d}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(p0,t,m0)}lookAt(t,e,i){let n=this.elements;return Ti.subVectors(t,e),Ti.lengthSq()===0&&(Ti.z=1),Ti.normalize(),On.crossVectors(i,Ti),On.lengthSq()===0&&(Math.abs(i.z)===1?Ti.x+=1e-4:Ti.z+=1e-4,Ti.normalize(),On.crossVectors(i,Ti)),On.normalize(),oa.crossVectors(Ti,On),n[0]=On.x,n[4]=oa.x,n[8]=Ti.x,n[1]=On.y,n[5]=oa.y,n[9]=Ti.y,n[2]=On.z,n[6]=oa.z,n[10]=Ti.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,n=e.elements,r=this.elements,o=i[0],a=i[4],l=i[8],c=i[12],h=i[1],u=i[5],d=i[9],f=i[13],m=i[2],x=i[6],p=i[10],g=i[14],_=i[3],b=i[7],y=i[11],M=i[15],S=n[0],v=n[4],w=n[8],E=n[12],R=n[1],L=n[5],D=n[9],U=n[13],N=n[2],V=n[6],k=n[10],B=n[14],Y=n[3],H=n[7],$=n[11],Z=n[15];return r[0]=o*S+a*R+l*N+c*Y,r[4]=o*v+a*L+l*V+c*H,r[8]=o*w+a*D+l*k+c*$,r[12]=o*E+a*U+l*B+c*Z,r[1]=h*S+u*R+d*N+f*Y,r[5]=h*v+u*L+d*V+f*H,r[9]=h*w+u*D+d*k+f*$,r[13]=h*E+u*U+d*B+f*Z,r[2]=m*S+x*R+p*N+g*Y,r[6]=m*v+x*L+p*V+g*H,r[10]=m*w+x*D+p*k+g*$,r[14]=m*E+x*U+p*B+g*Z,r[3]=_*S+b*R+y*N+M*Y,r[7]=_*v+b*L+y*V+M*H,r[11]=_*w+b*D+y*k+M*$,r[15]=_*E+b*U+y*B+M*Z,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[4],n=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],h=t[2],u=t[6],d=t[10],f=t[14],m=t[3],x=t[7],p=t[11],g=t[15],_=l*f-c*d,b=a*f-c*u,y=a*d-l*u,M=o*f-c*h,S=o*d-l*h,v=o*u-a*h;return e*(x*_-p*b+g*y)-i*(m*_-p*M+g*S)+n*(m*b-x*M+g*v)-r*(m*y-x*S+p*v)}determinantAffine(){let t=this.elements,e=t[0],i=t[4],n=t[8],r=t[1],o=t[5],a=t[9],l=t[2],c=t[6],h=t[10];return e*(o*h-a*c)-i*(r*h-a*l)+n*(r*c-o*l)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,i){let n=this.elements;return t.isVector3?(n[12]=t.x,n[13]=t.y,n[14]=t.z):(n[12]=t,n[13]=e,n[14]=i),this}invert(){let t=this.elements,e=t[0],i=t[1],n=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=t[9],d=t[10],f=t[11],m=t[12],x=t[13],p=t[14],g=t[15],_=e*a-i*o,b=e*l-n*o,y=e*c-r*o,M=i*l-n*a,S=i*c-r*a,v=n*c-r*l,w=h*x-u*m,E=h*p-d*m,R=h*g-f*m,L=u*p-d*x,D=u*g-f*x,U=d*g-f*p,N=_*U-b*D+y*L+M*R-S*E+v*w;if(N===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let V=1/N;return t[0]=(a*U-l*D+c*L)*V,t[1]=(n*D-i*U-r*L)*V,t[2]=(x*v-p*S+g*M)*V,t[3]=(d*S-u*v-f*M)*V,t[4]=(l*R-o*U-c*E)*V,t[5]=(e*U-n*R+r*E)*V,t[6]=(p*y-m*v-g*b)*V,t[7]=(h*v-d*y+f*b)*V,t[8]=(o*D-a*R+c*w)*V,t[9]=(i*R-e*D-r*w)*V,t[10]=(m*S-x*y+g*_)*V,t[11]=(u*y-h*S-f*_)*V,t[12]=(a*E-o*L-l*w)*V,t[13]=(e*L-i*E+n*w)*V,t[14]=(x*b-m*M-p*_)*V,t[15]=(h*M-u*b+d*_)*V,this}scale(t){let e=this.elements,i=t.x,n=t.y,r=t.z;return e[0]*=i,e[4]*=n,e[8]*=r,e[1]*=i,e[5]*=n,e[9]*=r,e[2]*=i,e[6]*=n,e[10]*=r,e[3]*=i,e[7]*=n,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],i=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],n=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,i,n))}makeTranslation(t,e,i){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,i,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),i=Math.sin(t);return this.set(1,0,0,0,0,e,-i,0,0,i,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,0,i,0,0,1,0,0,-i,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,0,i,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let i=Math.cos(e),n=Math.sin(e),r=1-i,o=t.x,a=t.y,l=t.z,c=r*o,h=r*a;return this.set(c*o+i,c*a-n*l,c*l+n*a,0,c*a+n*l,h*a+i,h*l-n*o,0,c*l-n*a,h*l+n*o,r*l*l+i,0,0,0,0,1),this}makeScale(t,e,i){return this.set(t,0,0,0,0,e,0,0,0,0,i,0,0,0,0,1),this}makeShear(t,e,i,n,r,o){return this.set(1,i,r,0,t,1,o,0,e,n,1,0,0,0,0,1),this}compose(t,e,i){let n=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,m=r*u,x=o*h,p=o*u,g=a*u,_=l*c,b=l*h,y=l*u,M=i.x,S=i.y,v=i.z;return n[0]=(1-(x+g))*M,n[1]=(f+y)*M,n[2]=(m-b)*M,n[3]=0,n[4]=(f-y)*S,n[5]=(1-(d+g))*S,n[6]=(p+_)*S,n[7]=0,n[8]=(m+b)*v,n[9]=(p-_)*v,n[10]=(1-(d+x))*v,n[11]=0,n[12]=t.x,n[13]=t.y,n[14]=t.z,n[15]=1,this}decompose(t,e,i){let n=this.elements;t.x=n[12],t.y=n[13],t.z=n[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),e.identity(),this;let o=Ys.set(n[0],n[1],n[2]).length(),a=Ys.set(n[4],n[5],n[6]).length(),l=Ys.set(n[8],n[9],n[10]).length();r<0&&(o=-o),Wi.copy(this);let c=1/o,h=1/a,u=1/l;return Wi.elements[0]*=c,Wi.elements[1]*=c,Wi.elements[2]*=c,Wi.elements[4]*=h,Wi.elements[5]*=h,Wi.elements[6]*=h,Wi.elements[8]*=u,Wi.elements[9]*=u,Wi.elements[10]*=u,e.setFromRotationMatrix(Wi),i.x=o,i.y=a,i.z=l,this}makePerspective(t,e,i,n,r,o,a=Di,l=!1){let c=this.elements,h=2*r/(e-t),u=2*r/(i-n),d=(e+t)/(e-t),f=(i+n)/(i-n),m,x;if(l)m=r/(o-r),x=o*r/(o-r);else if(a===Di)m=-(o+r)/(o-r),x=-2*o*r/(o-r);else if(a===cr)m=-o/(o-r),x=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=m,c[14]=x,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(t,e,i,n,r,o,a=Di,l=!1){let c=this.elements,h=2/(e-t),u=2/(i-n),d=-(e+t)/(e-t),f=-(i+n)/(i-n),m,x;if(l)m=1/(o-r),x=o/(o-r);else if(a===Di)m=-2/(o-r),x=-(o+r)/(o-r);else if(a===cr)m=-1/(o-r),x=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=m,c[14]=x,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(t){let e=this.elements,i=t.elements;for(let n=0;n<16;n++)if(e[n]!==i[n])return!1;return!0}fromArray(t,e=0){for(let i=0;i<16;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t[e+9]=i[9],t[e+10]=i[10],t[e+11]=i[11],t[e+12]=i[12],t[e+13]=i[13],t[e+14]=i[14],t[e+15]=i[15],t}},Ys=new C,Wi=new wt,p0=new C(0,0,0),m0=new C(1,1,1),On=new C,oa=new C,Ti=new C,kd=new wt,Fd=new Wt,Qe=class s{constructor(t=0,e=0,i=0,n=s.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=i,this._order=n}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,i,n=this._order){return this._x=t,this._y=e,this._z=i,this._order=n,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,i=!0){let n=t.elements,r=n[0],o=n[4],a=n[8],l=n[1],c=n[5],h=n[9],u=n[2],d=n[6],f=n[10];switch(e){case"XYZ":this._y=Math.asin(jt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-jt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(jt(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-jt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(jt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-jt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:Pt("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,i===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,i){return kd.makeRotationFromQuaternion(t),this.setFromRotationMatrix(kd,e,i)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return Fd.setFromEuler(this),this.setFromQuaternion(Fd,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Qe.DEFAULT_ORDER="XYZ";var fr=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},g0=0,Od=new C,$s=new Wt,xn=new wt,aa=new C,Hr=new C,x0=new C,y0=new Wt,Ud=new C(1,0,0),Bd=new C(0,1,0),Vd=new C(0,0,1),Hd={type:"added"},_0={type:"removed"},Zs={type:"childadded",child:null},dh={type:"childremoved",child:null},te=class s extends ji{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:g0++}),this.uuid=Qn(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=s.DEFAULT_UP.clone();let t=new C,e=new Qe,i=new Wt,n=new C(1,1,1);function r(){i.setFromEuler(e,!1)}function o(){e.setFromQuaternion(i,void 0,!1)}e._onChange(r),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:n},modelViewMatrix:{value:new wt},normalMatrix:{value:new Ot}}),this.matrix=new wt,this.matrixWorld=new wt,this.matrixAutoUpdate=s.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=s.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new fr,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return $s.setFromAxisAngle(t,e),this.quaternion.multiply($s),this}rotateOnWorldAxis(t,e){return $s.setFromAxisAngle(t,e),this.quaternion.premultiply($s),this}rotateX(t){return this.rotateOnAxis(Ud,t)}rotateY(t){return this.rotateOnAxis(Bd,t)}rotateZ(t){return this.rotateOnAxis(Vd,t)}translateOnAxis(t,e){return Od.copy(t).applyQuaternion(this.quaternion),this.position.add(Od.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Ud,t)}translateY(t){return this.translateOnAxis(Bd,t)}translateZ(t){return this.translateOnAxis(Vd,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(xn.copy(this.matrixWorld).invert())}lookAt(t,e,i){t.isVector3?aa.copy(t):aa.set(t,e,i);let n=this.parent;this.updateWorldMatrix(!0,!1),Hr.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?xn.lookAt(Hr,aa,this.up):xn.lookAt(aa,Hr,this.up),this.quaternion.setFromRotationMatrix(xn),n&&(xn.extractRotation(n.matrixWorld),$s.setFromRotationMatrix(xn),this.quaternion.premultiply($s.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(kt("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(Hd),Zs.child=t,this.dispatchEvent(Zs),Zs.child=null):kt("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(_0),dh.child=t,this.dispatchEvent(dh),dh.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),xn.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),xn.multiply(t.parent.matrixWorld)),t.applyMatrix4(xn),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(Hd),Zs.child=t,this.dispatchEvent(Zs),Zs.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let i=0,n=this.children.length;i<n;i++){let o=this.children[i].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,i=[]){this[t]===e&&i.push(this);let n=this.children;for(let r=0,o=n.length;r<o;r++)n[r].getObjectsByProperty(t,e,i);return i}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Hr,t,x0),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Hr,y0,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let i=0,n=e.length;i<n;i++)e[i].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let i=0,n=e.length;i<n;i++)e[i].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,i=t.y,n=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*i-r[8]*n,r[13]+=i-r[1]*e-r[5]*i-r[9]*n,r[14]+=n-r[2]*e-r[6]*i-r[10]*n}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let i=0,n=e.length;i<n;i++)e[i].updateMatrixWorld(t)}updateWorldMatrix(t,e,i=!1){let n=this.parent;if(t===!0&&n!==null&&n.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),e===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,i)}}toJSON(t){let e=t===void 0||typeof t=="string",i={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let n={};n.uuid=this.uuid,n.type=this.type,n.name=this.name,n.castShadow=this.castShadow,n.receiveShadow=this.receiveShadow,n.visible=this.visible,n.frustumCulled=this.frustumCulled,n.renderOrder=this.renderOrder,n.static=this.static,n.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(n.userData=this.userData),n.layers=this.layers.mask,n.matrix=this.matrix.toArray(),n.up=this.up.toArray(),this.pivot!==null&&(n.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(n.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(n.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(n.type="InstancedMesh",n.count=this.count,n.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(n.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(n.type="BatchedMesh",n.perObjectFrustumCulled=this.perObjectFrustumCulled,n.sortObjects=this.sortObjects,n.drawRanges=this._drawRanges,n.reservedRanges=this._reservedRanges,n.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),n.instanceInfo=this._instanceInfo.map(a=>({...a})),n.availableInstanceIds=this._availableInstanceIds.slice(),n.availableGeometryIds=this._availableGeometryIds.slice(),n.nextIndexStart=this._nextIndexStart,n.nextVertexStart=this._nextVertexStart,n.geometryCount=this._geometryCount,n.maxInstanceCount=this._maxInstanceCount,n.maxVertexCount=this._maxVertexCount,n.maxIndexCount=this._maxIndexCount,n.geometryInitialized=this._geometryInitialized,n.matricesTexture=this._matricesTexture.toJSON(t),n.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(n.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(n.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(n.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?n.background=this.background.toJSON():this.background.isTexture&&(n.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(n.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){n.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(t.shapes,u)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(n.bindMode=this.bindMode,n.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),n.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));n.material=a}else n.material=r(t.materials,this.material);if(this.children.length>0){n.children=[];for(let a=0;a<this.children.length;a++)n.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){n.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];n.animations.push(r(t.animations,l))}}if(e){let a=o(t.geometries),l=o(t.materials),c=o(t.textures),h=o(t.images),u=o(t.shapes),d=o(t.skeletons),f=o(t.animations),m=o(t.nodes);a.length>0&&(i.geometries=a),l.length>0&&(i.materials=l),c.length>0&&(i.textures=c),h.length>0&&(i.images=h),u.length>0&&(i.shapes=u),d.length>0&&(i.skeletons=d),f.length>0&&(i.animations=f),m.length>0&&(i.nodes=m)}return i.object=n,i;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let i=0;i<t.children.length;i++){let n=t.children[i];this.add(n.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};te.DEFAULT_UP=new C(0,1,0);te.DEFAULT_MATRIX_AUTO_UPDATE=!0;te.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Kt=class extends te{constructor(){super(),this.isGroup=!0,this.type="Group"}},v0={type:"move"},pr=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Kt,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Kt,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new C,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new C),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Kt,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new C,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new C,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let i of t.hand.values())this._getHandJoint(e,i)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,i){let n=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(let x of t.hand.values()){let p=e.getJointPose(x,i),g=this._getHandJoint(c,x);p!==null&&(g.matrix.fromArray(p.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=p.radius),g.visible=p!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,m=.005;c.inputState.pinching&&d>f+m?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&d<=f-m&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,i),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(n=e.getPose(t.targetRaySpace,i),n===null&&r!==null&&(n=r),n!==null&&(a.matrix.fromArray(n.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,n.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(n.linearVelocity)):a.hasLinearVelocity=!1,n.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(n.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(v0)))}return a!==null&&(a.visible=n!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let i=new Kt;i.matrixAutoUpdate=!1,i.visible=!1,t.joints[e.jointName]=i,t.add(i)}return t.joints[e.jointName]}},ap={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Un={h:0,s:0,l:0},la={h:0,s:0,l:0};function fh(s,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?s+(t-s)*6*e:e<1/2?t:e<2/3?s+(t-s)*6*(2/3-e):s}var It=class{constructor(t,e,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,i)}set(t,e,i){if(e===void 0&&i===void 0){let n=t;n&&n.isColor?this.copy(n):typeof n=="number"?this.setHex(n):typeof n=="string"&&this.setStyle(n)}else this.setRGB(t,e,i);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=oe){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,Ht.colorSpaceToWorking(this,e),this}setRGB(t,e,i,n=Ht.workingColorSpace){return this.r=t,this.g=e,this.b=i,Ht.colorSpaceToWorking(this,n),this}setHSL(t,e,i,n=Ht.workingColorSpace){if(t=yu(t,1),e=jt(e,0,1),i=jt(i,0,1),e===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+e):i+e-i*e,o=2*i-r;this.r=fh(o,r,t+1/3),this.g=fh(o,r,t),this.b=fh(o,r,t-1/3)}return Ht.colorSpaceToWorking(this,n),this}setStyle(t,e=oe){function i(r){r!==void 0&&parseFloat(r)<1&&Pt("Color: Alpha component of "+t+" will be ignored.")}let n;if(n=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=n[1],a=n[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:Pt("Color: Unknown color model "+t)}}else if(n=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=n[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);Pt("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=oe){let i=ap[t.toLowerCase()];return i!==void 0?this.setHex(i,e):Pt("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=wn(t.r),this.g=wn(t.g),this.b=wn(t.b),this}copyLinearToSRGB(t){return this.r=or(t.r),this.g=or(t.g),this.b=or(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=oe){return Ht.workingToColorSpace(Ke.copy(this),t),Math.round(jt(Ke.r*255,0,255))*65536+Math.round(jt(Ke.g*255,0,255))*256+Math.round(jt(Ke.b*255,0,255))}getHexString(t=oe){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=Ht.workingColorSpace){Ht.workingToColorSpace(Ke.copy(this),e);let i=Ke.r,n=Ke.g,r=Ke.b,o=Math.max(i,n,r),a=Math.min(i,n,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case i:l=(n-r)/u+(n<r?6:0);break;case n:l=(r-i)/u+2;break;case r:l=(i-n)/u+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=Ht.workingColorSpace){return Ht.workingToColorSpace(Ke.copy(this),e),t.r=Ke.r,t.g=Ke.g,t.b=Ke.b,t}getStyle(t=oe){Ht.workingToColorSpace(Ke.copy(this),t);let e=Ke.r,i=Ke.g,n=Ke.b;return t!==oe?`color(${t} ${e.toFixed(3)} ${i.toFixed(3)} ${n.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(i*255)},${Math.round(n*255)})`}offsetHSL(t,e,i){return this.getHSL(Un),this.setHSL(Un.h+t,Un.s+e,Un.l+i)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,i){return this.r=t.r+(e.r-t.r)*i,this.g=t.g+(e.g-t.g)*i,this.b=t.b+(e.b-t.b)*i,this}lerpHSL(t,e){this.getHSL(Un),t.getHSL(la);let i=Kr(Un.h,la.h,e),n=Kr(Un.s,la.s,e),r=Kr(Un.l,la.l,e);return this.setHSL(i,n,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,i=this.g,n=this.b,r=t.elements;return this.r=r[0]*e+r[3]*i+r[6]*n,this.g=r[1]*e+r[4]*i+r[7]*n,this.b=r[2]*e+r[5]*i+r[8]*n,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Ke=new It;It.NAMES=ap;var _s=class extends te{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Qe,this.environmentIntensity=1,this.environmentRotation=new Qe,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},Xi=new C,yn=new C,ph=new C,_n=new C,Js=new C,Ks=new C,Gd=new C,mh=new C,gh=new C,xh=new C,yh=new ae,_h=new ae,vh=new ae,sn=class s{constructor(t=new C,e=new C,i=new C){this.a=t,this.b=e,this.c=i}static getNormal(t,e,i,n){n.subVectors(i,e),Xi.subVectors(t,e),n.cross(Xi);let r=n.lengthSq();return r>0?n.multiplyScalar(1/Math.sqrt(r)):n.set(0,0,0)}static getBarycoord(t,e,i,n,r){Xi.subVectors(n,e),yn.subVectors(i,e),ph.subVectors(t,e);let o=Xi.dot(Xi),a=Xi.dot(yn),l=Xi.dot(ph),c=yn.dot(yn),h=yn.dot(ph),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,m=(o*h-a*l)*d;return r.set(1-f-m,m,f)}static containsPoint(t,e,i,n){return this.getBarycoord(t,e,i,n,_n)===null?!1:_n.x>=0&&_n.y>=0&&_n.x+_n.y<=1}static getInterpolation(t,e,i,n,r,o,a,l){return this.getBarycoord(t,e,i,n,_n)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,_n.x),l.addScaledVector(o,_n.y),l.addScaledVector(a,_n.z),l)}static getInterpolatedAttribute(t,e,i,n,r,o){return yh.setScalar(0),_h.setScalar(0),vh.setScalar(0),yh.fromBufferAttribute(t,e),_h.fromBufferAttribute(t,i),vh.fromBufferAttribute(t,n),o.setScalar(0),o.addScaledVector(yh,r.x),o.addScaledVector(_h,r.y),o.addScaledVector(vh,r.z),o}static isFrontFacing(t,e,i,n){return Xi.subVectors(i,e),yn.subVectors(t,e),Xi.cross(yn).dot(n)<0}set(t,e,i){return this.a.copy(t),this.b.copy(e),this.c.copy(i),this}setFromPointsAndIndices(t,e,i,n){return this.a.copy(t[e]),this.b.copy(t[i]),this.c.copy(t[n]),this}setFromAttributeAndIndices(t,e,i,n){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,i),this.c.fromBufferAttribute(t,n),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return Xi.subVectors(this.c,this.b),yn.subVectors(this.a,this.b),Xi.cross(yn).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return s.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return s.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,i,n,r){return s.getInterpolation(t,this.a,this.b,this.c,e,i,n,r)}containsPoint(t){return s.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return s.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let i=this.a,n=this.b,r=this.c,o,a;Js.subVectors(n,i),Ks.subVectors(r,i),mh.subVectors(t,i);let l=Js.dot(mh),c=Ks.dot(mh);if(l<=0&&c<=0)return e.copy(i);gh.subVectors(t,n);let h=Js.dot(gh),u=Ks.dot(gh);if(h>=0&&u<=h)return e.copy(n);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),e.copy(i).addScaledVector(Js,o);xh.subVectors(t,r);let f=Js.dot(xh),m=Ks.dot(xh);if(m>=0&&f<=m)return e.copy(r);let x=f*c-l*m;if(x<=0&&c>=0&&m<=0)return a=c/(c-m),e.copy(i).addScaledVector(Ks,a);let p=h*m-f*u;if(p<=0&&u-h>=0&&f-m>=0)return Gd.subVectors(r,n),a=(u-h)/(u-h+(f-m)),e.copy(n).addScaledVector(Gd,a);let g=1/(p+x+d);return o=x*g,a=d*g,e.copy(i).addScaledVector(Js,o).addScaledVector(Ks,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},Yi=class{constructor(t=new C(1/0,1/0,1/0),e=new C(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e+=3)this.expandByPoint(qi.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,i=t.count;e<i;e++)this.expandByPoint(qi.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let i=qi.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(i),this.max.copy(t).add(i),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let i=t.geometry;if(i!==void 0){let r=i.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,qi):qi.fromBufferAttribute(r,o),qi.applyMatrix4(t.matrixWorld),this.expandByPoint(qi);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),ca.copy(t.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),ca.copy(i.boundingBox)),ca.applyMatrix4(t.matrixWorld),this.union(ca)}let n=t.children;for(let r=0,o=n.length;r<o;r++)this.expandByObject(n[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,qi),qi.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,i;return t.normal.x>0?(e=t.normal.x*this.min.x,i=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,i=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,i+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,i+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,i+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,i+=t.normal.z*this.min.z),e<=-t.constant&&i>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(Gr),ha.subVectors(this.max,Gr),Qs.subVectors(t.a,Gr),tr.subVectors(t.b,Gr),er.subVectors(t.c,Gr),Bn.subVectors(tr,Qs),Vn.subVectors(er,tr),fs.subVectors(Qs,er);let e=[0,-Bn.z,Bn.y,0,-Vn.z,Vn.y,0,-fs.z,fs.y,Bn.z,0,-Bn.x,Vn.z,0,-Vn.x,fs.z,0,-fs.x,-Bn.y,Bn.x,0,-Vn.y,Vn.x,0,-fs.y,fs.x,0];return!bh(e,Qs,tr,er,ha)||(e=[1,0,0,0,1,0,0,0,1],!bh(e,Qs,tr,er,ha))?!1:(ua.crossVectors(Bn,Vn),e=[ua.x,ua.y,ua.z],bh(e,Qs,tr,er,ha))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,qi).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(qi).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(vn[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),vn[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),vn[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),vn[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),vn[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),vn[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),vn[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),vn[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(vn),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},vn=[new C,new C,new C,new C,new C,new C,new C,new C],qi=new C,ca=new Yi,Qs=new C,tr=new C,er=new C,Bn=new C,Vn=new C,fs=new C,Gr=new C,ha=new C,ua=new C,ps=new C;function bh(s,t,e,i,n){for(let r=0,o=s.length-3;r<=o;r+=3){ps.fromArray(s,r);let a=n.x*Math.abs(ps.x)+n.y*Math.abs(ps.y)+n.z*Math.abs(ps.z),l=t.dot(ps),c=e.dot(ps),h=i.dot(ps);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var Re=new C,da=new Rt,b0=0,pi=class extends ji{constructor(t,e,i=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:b0++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=i,this.usage=tp,this.updateRanges=[],this.gpuType=Fi,this.version=0,this._normalizationScale=t!==void 0?vu(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,i){t*=this.itemSize,i*=e.itemSize;for(let n=0,r=this.itemSize;n<r;n++)this.array[t+n]=e.array[i+n];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,i=this.count;e<i;e++)da.fromBufferAttribute(this,e),da.applyMatrix3(t),this.setXY(e,da.x,da.y);else if(this.itemSize===3)for(let e=0,i=this.count;e<i;e++)Re.fromBufferAttribute(this,e),Re.applyMatrix3(t),this.setXYZ(e,Re.x,Re.y,Re.z);return this}applyMatrix4(t){for(let e=0,i=this.count;e<i;e++)Re.fromBufferAttribute(this,e),Re.applyMatrix4(t),this.setXYZ(e,Re.x,Re.y,Re.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)Re.fromBufferAttribute(this,e),Re.applyNormalMatrix(t),this.setXYZ(e,Re.x,Re.y,Re.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)Re.fromBufferAttribute(this,e),Re.transformDirection(t),this.setXYZ(e,Re.x,Re.y,Re.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let i=this.array[t*this.itemSize+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.array[t*this.itemSize+e]=i,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,i){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.array[t+0]=e,this.array[t+1]=i,this}setXYZ(t,e,i,n){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),n=this._normalize(n)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=n,this}setXYZW(t,e,i,n,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),n=this._normalize(n),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=n,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):rp(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):op(t,this.array)}};var no=class extends pi{constructor(t,e,i){super(new Uint16Array(t),e,i)}};var so=class extends pi{constructor(t,e,i){super(new Uint32Array(t),e,i)}};var Ft=class extends pi{constructor(t,e,i){super(new Float32Array(t),e,i)}},S0=new Yi,Wr=new C,Sh=new C,rn=class{constructor(t=new C,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let i=this.center;e!==void 0?i.copy(e):S0.setFromPoints(t).getCenter(i);let n=0;for(let r=0,o=t.length;r<o;r++)n=Math.max(n,i.distanceToSquared(t[r]));return this.radius=Math.sqrt(n),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let i=this.center.distanceToSquared(t);return e.copy(t),i>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;Wr.subVectors(t,this.center);let e=Wr.lengthSq();if(e>this.radius*this.radius){let i=Math.sqrt(e),n=(i-this.radius)*.5;this.center.addScaledVector(Wr,n/i),this.radius+=n}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(Sh.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(Wr.copy(t.center).add(Sh)),this.expandByPoint(Wr.copy(t.center).sub(Sh))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},w0=0,Ni=new wt,wh=new te,ir=new C,Ai=new Yi,Xr=new Yi,Be=new C,ce=class s extends ji{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:w0++}),this.uuid=Qn(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(Yg(t)?so:no)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,i=0){this.groups.push({start:t,count:e,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new Ot().getNormalMatrix(t);i.applyNormalMatrix(r),i.needsUpdate=!0}let n=this.attributes.tangent;return n!==void 0&&(n.transformDirection(t),n.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return Ni.makeRotationFromQuaternion(t),this.applyMatrix4(Ni),this}rotateX(t){return Ni.makeRotationX(t),this.applyMatrix4(Ni),this}rotateY(t){return Ni.makeRotationY(t),this.applyMatrix4(Ni),this}rotateZ(t){return Ni.makeRotationZ(t),this.applyMatrix4(Ni),this}translate(t,e,i){return Ni.makeTranslation(t,e,i),this.applyMatrix4(Ni),this}scale(t,e,i){return Ni.makeScale(t,e,i),this.applyMatrix4(Ni),this}lookAt(t){return wh.lookAt(t),wh.updateMatrix(),this.applyMatrix4(wh.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(ir).negate(),this.translate(ir.x,ir.y,ir.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let i=[];for(let n=0,r=t.length;n<r;n++){let o=t[n];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new Ft(i,3))}else{let i=Math.min(t.length,e.count);for(let n=0;n<i;n++){let r=t[n];e.setXYZ(n,r.x,r.y,r.z||0)}t.length>e.count&&Pt("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Yi);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){kt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new C(-1/0,-1/0,-1/0),new C(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let i=0,n=e.length;i<n;i++){let r=e[i];Ai.setFromBufferAttribute(r),this.morphTargetsRelative?(Be.addVectors(this.boundingBox.min,Ai.min),this.boundingBox.expandByPoint(Be),Be.addVectors(this.boundingBox.max,Ai.max),this.boundingBox.expandByPoint(Be)):(this.boundingBox.expandByPoint(Ai.min),this.boundingBox.expandByPoint(Ai.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&kt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new rn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){kt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new C,1/0);return}if(t){let i=this.boundingSphere.center;if(Ai.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];Xr.setFromBufferAttribute(a),this.morphTargetsRelative?(Be.addVectors(Ai.min,Xr.min),Ai.expandByPoint(Be),Be.addVectors(Ai.max,Xr.max),Ai.expandByPoint(Be)):(Ai.expandByPoint(Xr.min),Ai.expandByPoint(Xr.max))}Ai.getCenter(i);let n=0;for(let r=0,o=t.count;r<o;r++)Be.fromBufferAttribute(t,r),n=Math.max(n,i.distanceToSquared(Be));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)Be.fromBufferAttribute(a,c),l&&(ir.fromBufferAttribute(t,c),Be.add(ir)),n=Math.max(n,i.distanceToSquared(Be))}this.boundingSphere.radius=Math.sqrt(n),isNaN(this.boundingSphere.radius)&&kt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){kt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=e.position,n=e.normal,r=e.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new pi(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(i.count);for(let E=0;E<i.count;E++)a[E]=new C,l[E]=new C;let h=new C,u=new C,d=new C,f=new Rt,m=new Rt,x=new Rt,p=new C,g=new C;function _(E,R,L){c[E]=c[R]=c[L]=1,h.fromBufferAttribute(i,E),u.fromBufferAttribute(i,R),d.fromBufferAttribute(i,L),f.fromBufferAttribute(r,E),m.fromBufferAttribute(r,R),x.fromBufferAttribute(r,L),u.sub(h),d.sub(h),m.sub(f),x.sub(f);let D=1/(m.x*x.y-x.x*m.y);isFinite(D)&&(p.copy(u).multiplyScalar(x.y).addScaledVector(d,-m.y).multiplyScalar(D),g.copy(d).multiplyScalar(m.x).addScaledVector(u,-x.x).multiplyScalar(D),a[E].add(p),a[R].add(p),a[L].add(p),l[E].add(g),l[R].add(g),l[L].add(g))}let b=this.groups;b.length===0&&(b=[{start:0,count:t.count}]);for(let E=0,R=b.length;E<R;++E){let L=b[E],D=L.start,U=L.count;for(let N=D,V=D+U;N<V;N+=3)_(t.getX(N+0),t.getX(N+1),t.getX(N+2))}let y=new C,M=new C,S=new C,v=new C;function w(E){S.fromBufferAttribute(n,E),v.copy(S);let R=a[E];y.copy(R),y.sub(S.multiplyScalar(S.dot(R))).normalize(),M.crossVectors(v,R);let D=M.dot(l[E])<0?-1:1;o.setXYZW(E,y.x,y.y,y.z,D)}for(let E=0,R=i.count;E<R;++E)c[E]&&w(E);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==e.count)i=new pi(new Float32Array(e.count*3),3),this.setAttribute("normal",i);else for(let d=0,f=i.count;d<f;d++)i.setXYZ(d,0,0,0);let n=new C,r=new C,o=new C,a=new C,l=new C,c=new C,h=new C,u=new C;if(t)for(let d=0,f=t.count;d<f;d+=3){let m=t.getX(d+0),x=t.getX(d+1),p=t.getX(d+2);n.fromBufferAttribute(e,m),r.fromBufferAttribute(e,x),o.fromBufferAttribute(e,p),h.subVectors(o,r),u.subVectors(n,r),h.cross(u),a.fromBufferAttribute(i,m),l.fromBufferAttribute(i,x),c.fromBufferAttribute(i,p),a.add(h),l.add(h),c.add(h),i.setXYZ(m,a.x,a.y,a.z),i.setXYZ(x,l.x,l.y,l.z),i.setXYZ(p,c.x,c.y,c.z)}else for(let d=0,f=e.count;d<f;d+=3)n.fromBufferAttribute(e,d+0),r.fromBufferAttribute(e,d+1),o.fromBufferAttribute(e,d+2),h.subVectors(o,r),u.subVectors(n,r),h.cross(u),i.setXYZ(d+0,h.x,h.y,h.z),i.setXYZ(d+1,h.x,h.y,h.z),i.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,i=t.count;e<i;e++)Be.fromBufferAttribute(t,e),Be.normalize(),t.setXYZ(e,Be.x,Be.y,Be.z)}toNonIndexed(){function t(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,m=0;for(let x=0,p=l.length;x<p;x++){a.isInterleavedBufferAttribute?f=l[x]*a.data.stride+a.offset:f=l[x]*h;for(let g=0;g<h;g++)d[m++]=c[f++]}return new pi(d,h,u)}if(this.index===null)return Pt("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new s,i=this.index.array,n=this.attributes;for(let a in n){let l=n[a],c=t(l,i);e.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=t(d,i);l.push(f)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let i=this.attributes;for(let l in i){let c=i[l];t.data.attributes[l]=c.toJSON(t.data)}let n={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(t.data))}h.length>0&&(n[l]=h,r=!0)}r&&(t.data.morphAttributes=n,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let i=t.index;i!==null&&this.setIndex(i.clone());let n=t.attributes;for(let c in n){let h=n[c];this.setAttribute(c,h.clone(e))}let r=t.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var Mh=new C,M0=new C,T0=new Ot,Ei=class{constructor(t=new C(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,i,n){return this.normal.set(t,e,i),this.constant=n,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,i){let n=Mh.subVectors(i,e).cross(M0.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(n,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,i=!0){let n=t.delta(Mh),r=this.normal.dot(n);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/r;return i===!0&&(o<0||o>1)?null:e.copy(t.start).addScaledVector(n,o)}intersectsLine(t){let e=this.distanceToPoint(t.start),i=this.distanceToPoint(t.end);return e<0&&i>0||i<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let i=e||T0.getNormalMatrix(t),n=this.coplanarPoint(Mh).applyMatrix4(t),r=this.normal.applyMatrix3(i).normalize();return this.constant=-n.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},A0=0,mi=class extends ji{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:A0++}),this.uuid=Qn(),this.name="",this.type="Material",this.blending=Mr,this.side=cn,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Zh,this.blendDst=Jh,this.blendEquation=Is,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new It(0,0,0),this.blendAlpha=0,this.depthFunc=lr,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Yf,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Na,this.stencilZFail=Na,this.stencilZPass=Na,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let i=t[e];if(i===void 0){Pt(`Material: parameter '${e}' has value of undefined.`);continue}let n=this[e];if(n===void 0){Pt(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}n&&n.isColor?n.set(i):n&&n.isVector2&&i&&i.isVector2||n&&n.isEuler&&i&&i.isEuler||n&&n.isVector3&&i&&i.isVector3?n.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(t).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(t).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(t).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(t).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(t).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function n(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(e){let r=n(t.textures),o=n(t.images);r.length>0&&(i.textures=r),o.length>0&&(i.images=o)}return i}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new It().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(i=>new Ei().fromJSON(i))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let i=t.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new Rt().fromArray(i)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new Rt().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,i=null;if(e!==null){let n=e.length;i=new Array(n);for(let r=0;r!==n;++r)i[r]=e[r].clone()}return this.clippingPlanes=i,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var bn=new C,Th=new C,fa=new C,pa=new C,on=class{constructor(t=new C,e=new C(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,bn)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let i=e.dot(this.direction);return i<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=bn.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(bn.copy(this.origin).addScaledVector(this.direction,e),bn.distanceToSquared(t))}distanceSqToSegment(t,e,i,n){Th.copy(t).add(e).multiplyScalar(.5),fa.copy(e).sub(t).normalize(),pa.copy(this.origin).sub(Th);let r=t.distanceTo(e)*.5,o=-this.direction.dot(fa),a=pa.dot(this.direction),l=-pa.dot(fa),c=pa.lengthSq(),h=Math.abs(1-o*o),u,d,f,m;if(h>0)if(u=o*l-a,d=o*a-l,m=r*h,u>=0)if(d>=-m)if(d<=m){let x=1/h;u*=x,d*=x,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-m?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=m?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return i&&i.copy(this.origin).addScaledVector(this.direction,u),n&&n.copy(Th).addScaledVector(fa,d),f}intersectSphere(t,e){if(t.radius<0)return null;bn.subVectors(t.center,this.origin);let i=bn.dot(this.direction),n=bn.dot(bn)-i*i,r=t.radius*t.radius;if(n>r)return null;let o=Math.sqrt(r-n),a=i-o,l=i+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(t.normal)+t.constant)/e;return i>=0?i:null}intersectPlane(t,e){let i=this.distanceToPlane(t);return i===null?null:this.at(i,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let i,n,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(i=(t.min.x-d.x)*c,n=(t.max.x-d.x)*c):(i=(t.max.x-d.x)*c,n=(t.min.x-d.x)*c),h>=0?(r=(t.min.y-d.y)*h,o=(t.max.y-d.y)*h):(r=(t.max.y-d.y)*h,o=(t.min.y-d.y)*h),i>o||r>n||((r>i||isNaN(i))&&(i=r),(o<n||isNaN(n))&&(n=o),u>=0?(a=(t.min.z-d.z)*u,l=(t.max.z-d.z)*u):(a=(t.max.z-d.z)*u,l=(t.min.z-d.z)*u),i>l||a>n)||((a>i||i!==i)&&(i=a),(l<n||n!==n)&&(n=l),n<0)?null:this.at(i>=0?i:n,e)}intersectsBox(t){return this.intersectBox(t,bn)!==null}intersectTriangle(t,e,i,n,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=t.x-o.x,d=t.y-o.y,f=t.z-o.z,m=e.x-o.x,x=e.y-o.y,p=e.z-o.z,g=i.x-o.x,_=i.y-o.y,b=i.z-o.z,y=Math.abs(l),M=Math.abs(c),S=Math.abs(h),v,w,E,R,L,D,U,N,V,k,B,Y;if(y>=M&&y>=S?(E=l,D=u,V=m,Y=g,l>=0?(v=c,w=h,R=d,L=f,U=x,N=p,k=_,B=b):(v=h,w=c,R=f,L=d,U=p,N=x,k=b,B=_)):M>=S?(E=c,D=d,V=x,Y=_,c>=0?(v=h,w=l,R=f,L=u,U=p,N=m,k=b,B=g):(v=l,w=h,R=u,L=f,U=m,N=p,k=g,B=b)):(E=h,D=f,V=p,Y=b,h>=0?(v=l,w=c,R=u,L=d,U=m,N=x,k=g,B=_):(v=c,w=l,R=d,L=u,U=x,N=m,k=_,B=g)),E===0)return null;let H=v/E,$=w/E,Z=1/E,ct=R-H*D,ut=L-$*D,G=U-H*V,Q=N-$*V,et=k-H*Y,rt=B-$*Y,at=et*Q-rt*G,Lt=ct*rt-ut*et,le=G*ut-Q*ct;if(n){if(at<0||Lt<0||le<0)return null}else if((at<0||Lt<0||le<0)&&(at>0||Lt>0||le>0))return null;let Nt=at+Lt+le;if(Nt===0)return null;let se=Z*(at*D+Lt*V+le*Y);return(Nt>0?se<0:se>0)?null:this.at(se/Nt,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},ti=class extends mi{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new It(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Qe,this.combine=To,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},Wd=new wt,ms=new on,ma=new rn,Xd=new C,ga=new C,xa=new C,ya=new C,Ah=new C,_a=new C,qd=new C,va=new C,st=class extends te{constructor(t=new ce,e=new ti){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let n=e[i[0]];if(n!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=n.length;r<o;r++){let a=n[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let i=this.geometry,n=i.attributes.position,r=i.morphAttributes.position,o=i.morphTargetsRelative;e.fromBufferAttribute(n,t);let a=this.morphTargetInfluences;if(r&&a){_a.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(Ah.fromBufferAttribute(u,t),o?_a.addScaledVector(Ah,h):_a.addScaledVector(Ah.sub(e),h))}e.add(_a)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,n=this.material,r=this.matrixWorld;n!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),ma.copy(i.boundingSphere),ma.applyMatrix4(r),ms.copy(t.ray).recast(t.near),!(ma.containsPoint(ms.origin)===!1&&(ms.intersectSphere(ma,Xd)===null||ms.origin.distanceToSquared(Xd)>(t.far-t.near)**2))&&(Wd.copy(r).invert(),ms.copy(t.ray).applyMatrix4(Wd),!(i.boundingBox!==null&&ms.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(t,e,ms)))}_computeIntersections(t,e,i){let n,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let m=0,x=d.length;m<x;m++){let p=d[m],g=o[p.materialIndex],_=Math.max(p.start,f.start),b=Math.min(a.count,Math.min(p.start+p.count,f.start+f.count));for(let y=_,M=b;y<M;y+=3){let S=a.getX(y),v=a.getX(y+1),w=a.getX(y+2);n=ba(this,g,t,i,c,h,u,S,v,w),n&&(n.faceIndex=Math.floor(y/3),n.face.materialIndex=p.materialIndex,e.push(n))}}else{let m=Math.max(0,f.start),x=Math.min(a.count,f.start+f.count);for(let p=m,g=x;p<g;p+=3){let _=a.getX(p),b=a.getX(p+1),y=a.getX(p+2);n=ba(this,o,t,i,c,h,u,_,b,y),n&&(n.faceIndex=Math.floor(p/3),e.push(n))}}else if(l!==void 0)if(Array.isArray(o))for(let m=0,x=d.length;m<x;m++){let p=d[m],g=o[p.materialIndex],_=Math.max(p.start,f.start),b=Math.min(l.count,Math.min(p.start+p.count,f.start+f.count));for(let y=_,M=b;y<M;y+=3){let S=y,v=y+1,w=y+2;n=ba(this,g,t,i,c,h,u,S,v,w),n&&(n.faceIndex=Math.floor(y/3),n.face.materialIndex=p.materialIndex,e.push(n))}}else{let m=Math.max(0,f.start),x=Math.min(l.count,f.start+f.count);for(let p=m,g=x;p<g;p+=3){let _=p,b=p+1,y=p+2;n=ba(this,o,t,i,c,h,u,_,b,y),n&&(n.faceIndex=Math.floor(p/3),e.push(n))}}}};function E0(s,t,e,i,n,r,o,a){let l;if(t.side===ui?l=i.intersectTriangle(o,r,n,!0,a):l=i.intersectTriangle(n,r,o,t.side===cn,a),l===null)return null;va.copy(a),va.applyMatrix4(s.matrixWorld);let c=e.ray.origin.distanceTo(va);return c<e.near||c>e.far?null:{distance:c,point:va.clone(),object:s}}function ba(s,t,e,i,n,r,o,a,l,c){s.getVertexPosition(a,ga),s.getVertexPosition(l,xa),s.getVertexPosition(c,ya);let h=E0(s,t,e,i,ga,xa,ya,qd);if(h){let u=new C;sn.getBarycoord(qd,ga,xa,ya,u),n&&(h.uv=sn.getInterpolatedAttribute(n,a,l,c,u,new Rt)),r&&(h.uv1=sn.getInterpolatedAttribute(r,a,l,c,u,new Rt)),o&&(h.normal=sn.getInterpolatedAttribute(o,a,l,c,u,new C),h.normal.dot(i.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new C,materialIndex:0};sn.getNormal(ga,xa,ya,d.normal),h.face=d,h.barycoord=u}return h}var qr=new ae,jd=new ae,Yd=new ae,R0=new ae,$d=new wt,Sa=new C,Eh=new rn,Zd=new wt,Rh=new on,ro=class extends st{constructor(t,e){super(t,e),this.isSkinnedMesh=!0,this.type="SkinnedMesh",this.bindMode=Ih,this.bindMatrix=new wt,this.bindMatrixInverse=new wt,this.boundingBox=null,this.boundingSphere=null}computeBoundingBox(){let t=this.geometry;this.boundingBox===null&&(this.boundingBox=new Yi),this.boundingBox.makeEmpty();let e=t.getAttribute("position");for(let i=0;i<e.count;i++)this.getVertexPosition(i,Sa),this.boundingBox.expandByPoint(Sa)}computeBoundingSphere(){let t=this.geometry;this.boundingSphere===null&&(this.boundingSphere=new rn),this.boundingSphere.makeEmpty();let e=t.getAttribute("position");for(let i=0;i<e.count;i++)this.getVertexPosition(i,Sa),this.boundingSphere.expandByPoint(Sa)}copy(t,e){return super.copy(t,e),this.bindMode=t.bindMode,this.bindMatrix.copy(t.bindMatrix),this.bindMatrixInverse.copy(t.bindMatrixInverse),this.skeleton=t.skeleton,this.boundingBox=t.boundingBox!==null?t.boundingBox.clone():null,this.boundingSphere=t.boundingSphere!==null?t.boundingSphere.clone():null,this}raycast(t,e){let i=this.material,n=this.matrixWorld;i!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),Eh.copy(this.boundingSphere),Eh.applyMatrix4(n),t.ray.intersectsSphere(Eh)!==!1&&(Zd.copy(n).invert(),Rh.copy(t.ray).applyMatrix4(Zd),!(this.boundingBox!==null&&Rh.intersectsBox(this.boundingBox)===!1)&&this._computeIntersections(t,e,Rh)))}getVertexPosition(t,e){return super.getVertexPosition(t,e),this.applyBoneTransform(t,e),e}bind(t,e){this.skeleton=t,e===void 0&&(this.updateMatrixWorld(!0),this.skeleton.calculateInverses(),e=this.matrixWorld),this.bindMatrix.copy(e),this.bindMatrixInverse.copy(e).invert()}pose(){this.skeleton.pose()}normalizeSkinWeights(){let t=new ae,e=this.geometry.attributes.skinWeight;for(let i=0,n=e.count;i<n;i++){t.fromBufferAttribute(e,i);let r=1/t.manhattanLength();r!==1/0?t.multiplyScalar(r):t.set(1,0,0,0),e.setXYZW(i,t.x,t.y,t.z,t.w)}}updateMatrixWorld(t){super.updateMatrixWorld(t),this.bindMode===Ih?this.bindMatrixInverse.copy(this.matrixWorld).invert():this.bindMode===Gf?this.bindMatrixInverse.copy(this.bindMatrix).invert():Pt("SkinnedMesh: Unrecognized bindMode: "+this.bindMode)}applyBoneTransform(t,e){let i=this.skeleton,n=this.geometry;jd.fromBufferAttribute(n.attributes.skinIndex,t),Yd.fromBufferAttribute(n.attributes.skinWeight,t),e.isVector4?(qr.copy(e),e.set(0,0,0,0)):(qr.set(e.x,e.y,e.z,1),e.set(0,0,0)),qr.applyMatrix4(this.bindMatrix);for(let r=0;r<4;r++){let o=Yd.getComponent(r);if(o!==0){let a=jd.getComponent(r);$d.multiplyMatrices(i.bones[a].matrixWorld,i.boneInverses[a]),e.addScaledVector(R0.copy(qr).applyMatrix4($d),o)}}return e.isVector4&&(e.w=qr.w),e.applyMatrix4(this.bindMatrixInverse)}},mr=class extends te{constructor(){super(),this.isBone=!0,this.type="Bone"}},vs=class extends hi{constructor(t=null,e=1,i=1,n,r,o,a,l,c=He,h=He,u,d){super(null,o,a,l,c,h,n,r,u,d),this.isDataTexture=!0,this.image={data:t,width:e,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}},Jd=new wt,C0=new wt,oo=class s{constructor(t=[],e=[]){this.uuid=Qn(),this.bones=t.slice(0),this.boneInverses=e,this.boneMatrices=null,this.previousBoneMatrices=null,this.boneTexture=null,this.previousBoneTexture=null,this.init()}init(){let t=this.bones,e=this.boneInverses;if(this.boneMatrices=new Float32Array(t.length*16),e.length===0)this.calculateInverses();else if(t.length!==e.length){Pt("Skeleton: Number of inverse bone matrices does not match amount of bones."),this.boneInverses=[];for(let i=0,n=this.bones.length;i<n;i++)this.boneInverses.push(new wt)}}calculateInverses(){this.boneInverses.length=0;for(let t=0,e=this.bones.length;t<e;t++){let i=new wt;this.bones[t]&&i.copy(this.bones[t].matrixWorld).invert(),this.boneInverses.push(i)}}pose(){for(let t=0,e=this.bones.length;t<e;t++){let i=this.bones[t];i&&i.matrixWorld.copy(this.boneInverses[t]).invert()}for(let t=0,e=this.bones.length;t<e;t++){let i=this.bones[t];i&&(i.parent&&i.parent.isBone?(i.matrix.copy(i.parent.matrixWorld).invert(),i.matrix.multiply(i.matrixWorld)):i.matrix.copy(i.matrixWorld),i.matrix.decompose(i.position,i.quaternion,i.scale))}}update(){let t=this.bones,e=this.boneInverses,i=this.boneMatrices,n=this.boneTexture;for(let r=0,o=t.length;r<o;r++){let a=t[r]?t[r].matrixWorld:C0;Jd.multiplyMatrices(a,e[r]),Jd.toArray(i,r*16)}n!==null&&(n.needsUpdate=!0)}clone(){return new s(this.bones,this.boneInverses)}computeBoneTexture(){let t=Math.sqrt(this.bones.length*4);t=Math.ceil(t/4)*4,t=Math.max(t,4);let e=new Float32Array(t*t*4);e.set(this.boneMatrices);let i=new vs(e,t,t,Oi,Fi);return i.needsUpdate=!0,this.boneMatrices=e,this.boneTexture=i,this}getBoneByName(t){for(let e=0,i=this.bones.length;e<i;e++){let n=this.bones[e];if(n.name===t)return n}}dispose(){this.boneTexture!==null&&(this.boneTexture.dispose(),this.boneTexture=null),this.previousBoneTexture!==null&&(this.previousBoneTexture.dispose(),this.previousBoneTexture=null)}fromJSON(t,e){this.uuid=t.uuid;for(let i=0,n=t.bones.length;i<n;i++){let r=t.bones[i],o=e[r];o===void 0&&(Pt("Skeleton: No bone found with UUID:",r),o=new mr),this.bones.push(o),this.boneInverses.push(new wt().fromArray(t.boneInverses[i]))}return this.init(),this}toJSON(){let t={metadata:{version:4.7,type:"Skeleton",generator:"Skeleton.toJSON"},bones:[],boneInverses:[]};t.uuid=this.uuid;let e=this.bones,i=this.boneInverses;for(let n=0,r=e.length;n<r;n++){let o=e[n];t.bones.push(o.uuid);let a=i[n];t.boneInverses.push(a.toArray())}return t}};var gs=new rn,P0=new Rt(.5,.5),wa=new C,Wn=class{constructor(t=new Ei,e=new Ei,i=new Ei,n=new Ei,r=new Ei,o=new Ei){this.planes=[t,e,i,n,r,o]}set(t,e,i,n,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(i),a[3].copy(n),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let i=0;i<6;i++)e[i].copy(t.planes[i]);return this}setFromProjectionMatrix(t,e=Di,i=!1){let n=this.planes,r=t.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],m=r[8],x=r[9],p=r[10],g=r[11],_=r[12],b=r[13],y=r[14],M=r[15];if(n[0].setComponents(c-o,f-h,g-m,M-_).normalize(),n[1].setComponents(c+o,f+h,g+m,M+_).normalize(),n[2].setComponents(c+a,f+u,g+x,M+b).normalize(),n[3].setComponents(c-a,f-u,g-x,M-b).normalize(),i)n[4].setComponents(l,d,p,y).normalize(),n[5].setComponents(c-l,f-d,g-p,M-y).normalize();else if(n[4].setComponents(c-l,f-d,g-p,M-y).normalize(),e===Di)n[5].setComponents(c+l,f+d,g+p,M+y).normalize();else if(e===cr)n[5].setComponents(l,d,p,y).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),gs.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),gs.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(gs)}intersectsSprite(t){gs.center.set(0,0,0);let e=P0.distanceTo(t.center);return gs.radius=.7071067811865476+e,gs.applyMatrix4(t.matrixWorld),this.intersectsSphere(gs)}intersectsSphere(t){let e=this.planes,i=t.center,n=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(i)<n)return!1;return!0}intersectsBox(t){let e=this.planes;for(let i=0;i<6;i++){let n=e[i];if(wa.x=n.normal.x>0?t.max.x:t.min.x,wa.y=n.normal.y>0?t.max.y:t.min.y,wa.z=n.normal.z>0?t.max.z:t.min.z,n.distanceToPoint(wa)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let i=0;i<6;i++)if(e[i].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Kd=new wt,qa=class s{constructor(){this.coordinateSystem=Di,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,i=this._frustums;for(let n=0;n<e.length;n++){let r=e[n];Kd.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[n]===void 0&&(i[n]=new Wn),i[n].setFromProjectionMatrix(Kd,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,i=t._frustums;for(let n=0;n<t._count;n++)e[n]===void 0&&(e[n]=new Wn),e[n].copy(i[n]);return this._count=t._count,this}clone(){return new s().copy(this)}};var ei=class extends mi{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new It(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},ja=new C,Ya=new C,Qd=new wt,jr=new on,Ma=new rn,Ch=new C,tf=new C,Ge=class extends te{constructor(t=new ce,e=new ei){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,i=[0];for(let n=1,r=e.count;n<r;n++)ja.fromBufferAttribute(e,n-1),Ya.fromBufferAttribute(e,n),i[n]=i[n-1],i[n]+=ja.distanceTo(Ya);t.setAttribute("lineDistance",new Ft(i,1))}else Pt("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,n=this.matrixWorld,r=t.params.Line.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),Ma.copy(i.boundingSphere),Ma.applyMatrix4(n),Ma.radius+=r,t.ray.intersectsSphere(Ma)===!1)return;Qd.copy(n).invert(),jr.copy(t.ray).applyMatrix4(Qd);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=i.index,d=i.attributes.position;if(h!==null){let f=Math.max(0,o.start),m=Math.min(h.count,o.start+o.count);for(let x=f,p=m-1;x<p;x+=c){let g=h.getX(x),_=h.getX(x+1),b=Ta(this,t,jr,l,g,_,x);b&&e.push(b)}if(this.isLineLoop){let x=h.getX(m-1),p=h.getX(f),g=Ta(this,t,jr,l,x,p,m-1);g&&e.push(g)}}else{let f=Math.max(0,o.start),m=Math.min(d.count,o.start+o.count);for(let x=f,p=m-1;x<p;x+=c){let g=Ta(this,t,jr,l,x,x+1,x);g&&e.push(g)}if(this.isLineLoop){let x=Ta(this,t,jr,l,m-1,f,m-1);x&&e.push(x)}}}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let n=e[i[0]];if(n!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=n.length;r<o;r++){let a=n[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Ta(s,t,e,i,n,r,o){let a=s.geometry.attributes.position;if(ja.fromBufferAttribute(a,n),Ya.fromBufferAttribute(a,r),e.distanceSqToSegment(ja,Ya,Ch,tf)>i)return;Ch.applyMatrix4(s.matrixWorld);let c=t.ray.origin.distanceTo(Ch);if(!(c<t.near||c>t.far))return{distance:c,point:tf.clone().applyMatrix4(s.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:s}}var ef=new C,nf=new C,An=class extends Ge{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,i=[];for(let n=0,r=e.count;n<r;n+=2)ef.fromBufferAttribute(e,n),nf.fromBufferAttribute(e,n+1),i[n]=n===0?0:i[n-1],i[n+1]=i[n]+ef.distanceTo(nf);t.setAttribute("lineDistance",new Ft(i,1))}else Pt("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}},ao=class extends Ge{constructor(t,e){super(t,e),this.isLineLoop=!0,this.type="LineLoop"}},En=class extends mi{constructor(t){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new It(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.size=t.size,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}},sf=new wt,zh=new on,Aa=new rn,Ea=new C,bs=class extends te{constructor(t=new ce,e=new En){super(),this.isPoints=!0,this.type="Points",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,n=this.matrixWorld,r=t.params.Points.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),Aa.copy(i.boundingSphere),Aa.applyMatrix4(n),Aa.radius+=r,t.ray.intersectsSphere(Aa)===!1)return;sf.copy(n).invert(),zh.copy(t.ray).applyMatrix4(sf);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=i.index,u=i.attributes.position;if(c!==null){let d=Math.max(0,o.start),f=Math.min(c.count,o.start+o.count);for(let m=d,x=f;m<x;m++){let p=c.getX(m);Ea.fromBufferAttribute(u,p),rf(Ea,p,l,n,t,e,this)}}else{let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let m=d,x=f;m<x;m++)Ea.fromBufferAttribute(u,m),rf(Ea,m,l,n,t,e,this)}}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let n=e[i[0]];if(n!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=n.length;r<o;r++){let a=n[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function rf(s,t,e,i,n,r,o){let a=zh.distanceSqToPoint(s);if(a<e){let l=new C;zh.closestPointToPoint(s,l),l.applyMatrix4(i);let c=n.ray.origin.distanceTo(l);if(c<n.near||c>n.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:t,face:null,faceIndex:null,barycoord:null,object:o})}}var lo=class extends hi{constructor(t=[],e=Ls,i,n,r,o,a,l,c,h){super(t,e,i,n,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}};var Rn=class extends hi{constructor(t,e,i=Zi,n,r,o,a=He,l=He,c,h=Tn,u=1){if(h!==Tn&&h!==Ln)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:t,height:e,depth:u};super(d,n,r,o,a,l,h,i,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new dr(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},co=class extends Rn{constructor(t,e=Zi,i=Ls,n,r,o=He,a=He,l,c=Tn){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,i,n,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},ho=class extends hi{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},ye=class s extends ce{constructor(t=1,e=1,i=1,n=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:i,widthSegments:n,heightSegments:r,depthSegments:o};let a=this;n=Math.floor(n),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;m("z","y","x",-1,-1,i,e,t,o,r,0),m("z","y","x",1,-1,i,e,-t,o,r,1),m("x","z","y",1,1,t,i,e,n,o,2),m("x","z","y",1,-1,t,i,-e,n,o,3),m("x","y","z",1,-1,t,e,i,n,r,4),m("x","y","z",-1,-1,t,e,-i,n,r,5),this.setIndex(l),this.setAttribute("position",new Ft(c,3)),this.setAttribute("normal",new Ft(h,3)),this.setAttribute("uv",new Ft(u,2));function m(x,p,g,_,b,y,M,S,v,w,E){let R=y/v,L=M/w,D=y/2,U=M/2,N=S/2,V=v+1,k=w+1,B=0,Y=0,H=new C;for(let $=0;$<k;$++){let Z=$*L-U;for(let ct=0;ct<V;ct++){let ut=ct*R-D;H[x]=ut*_,H[p]=Z*b,H[g]=N,c.push(H.x,H.y,H.z),H[x]=0,H[p]=0,H[g]=S>0?1:-1,h.push(H.x,H.y,H.z),u.push(ct/v),u.push(1-$/w),B+=1}}for(let $=0;$<w;$++)for(let Z=0;Z<v;Z++){let ct=d+Z+V*$,ut=d+Z+V*($+1),G=d+(Z+1)+V*($+1),Q=d+(Z+1)+V*$;l.push(ct,ut,Q),l.push(ut,G,Q),Y+=6}a.addGroup(f,Y,E),f+=Y,d+=B}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var Me=class s extends ce{constructor(t=1,e=1,i=1,n=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:i,radialSegments:n,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;n=Math.floor(n),r=Math.floor(r);let h=[],u=[],d=[],f=[],m=0,x=[],p=i/2,g=0;_(),o===!1&&(t>0&&b(!0),e>0&&b(!1)),this.setIndex(h),this.setAttribute("position",new Ft(u,3)),this.setAttribute("normal",new Ft(d,3)),this.setAttribute("uv",new Ft(f,2));function _(){let y=new C,M=new C,S=0,v=(e-t)/i;for(let w=0;w<=r;w++){let E=[],R=w/r,L=R*(e-t)+t;for(let D=0;D<=n;D++){let U=D/n,N=U*l+a,V=Math.sin(N),k=Math.cos(N);M.x=L*V,M.y=-R*i+p,M.z=L*k,u.push(M.x,M.y,M.z),y.set(V,v,k).normalize(),d.push(y.x,y.y,y.z),f.push(U,1-R),E.push(m++)}x.push(E)}for(let w=0;w<n;w++)for(let E=0;E<r;E++){let R=x[E][w],L=x[E+1][w],D=x[E+1][w+1],U=x[E][w+1];(t>0||E!==0)&&(h.push(R,L,U),S+=3),(e>0||E!==r-1)&&(h.push(L,D,U),S+=3)}c.addGroup(g,S,0),g+=S}function b(y){let M=m,S=new Rt,v=new C,w=0,E=y===!0?t:e,R=y===!0?1:-1;for(let D=1;D<=n;D++)u.push(0,p*R,0),d.push(0,R,0),f.push(.5,.5),m++;let L=m;for(let D=0;D<=n;D++){let N=D/n*l+a,V=Math.cos(N),k=Math.sin(N);v.x=E*k,v.y=p*R,v.z=E*V,u.push(v.x,v.y,v.z),d.push(0,R,0),S.x=V*.5+.5,S.y=k*.5*R+.5,f.push(S.x,S.y),m++}for(let D=0;D<n;D++){let U=M+D,N=L+D;y===!0?h.push(N,N+1,U):h.push(N+1,N,U),w+=3}c.addGroup(g,w,y===!0?1:2),g+=w}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}},uo=class s extends Me{constructor(t=1,e=1,i=32,n=1,r=!1,o=0,a=Math.PI*2){super(0,t,e,i,n,r,o,a),this.type="ConeGeometry",this.parameters={radius:t,height:e,radialSegments:i,heightSegments:n,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(t){return new s(t.radius,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}},$a=class s extends ce{constructor(t=[],e=[],i=1,n=0){super(),this.type="PolyhedronGeometry",this.parameters={vertices:t,indices:e,radius:i,detail:n};let r=[],o=[];a(n),c(i),h(),this.setAttribute("position",new Ft(r,3)),this.setAttribute("normal",new Ft(r.slice(),3)),this.setAttribute("uv",new Ft(o,2)),n===0?this.computeVertexNormals():this.normalizeNormals();function a(_){let b=new C,y=new C,M=new C;for(let S=0;S<e.length;S+=3)f(e[S+0],b),f(e[S+1],y),f(e[S+2],M),l(b,y,M,_)}function l(_,b,y,M){let S=M+1,v=[];for(let w=0;w<=S;w++){v[w]=[];let E=_.clone().lerp(y,w/S),R=b.clone().lerp(y,w/S),L=S-w;for(let D=0;D<=L;D++)D===0&&w===S?v[w][D]=E:v[w][D]=E.clone().lerp(R,D/L)}for(let w=0;w<S;w++)for(let E=0;E<2*(S-w)-1;E++){let R=Math.floor(E/2);E%2===0?(d(v[w][R+1]),d(v[w+1][R]),d(v[w][R])):(d(v[w][R+1]),d(v[w+1][R+1]),d(v[w+1][R]))}}function c(_){let b=new C;for(let y=0;y<r.length;y+=3)b.x=r[y+0],b.y=r[y+1],b.z=r[y+2],b.normalize().multiplyScalar(_),r[y+0]=b.x,r[y+1]=b.y,r[y+2]=b.z}function h(){let _=new C;for(let b=0;b<r.length;b+=3){_.x=r[b+0],_.y=r[b+1],_.z=r[b+2];let y=p(_)/2/Math.PI+.5,M=g(_)/Math.PI+.5;o.push(y,1-M)}m(),u()}function u(){for(let _=0;_<o.length;_+=6){let b=o[_+0],y=o[_+2],M=o[_+4],S=Math.max(b,y,M),v=Math.min(b,y,M);S>.9&&v<.1&&(b<.2&&(o[_+0]+=1),y<.2&&(o[_+2]+=1),M<.2&&(o[_+4]+=1))}}function d(_){r.push(_.x,_.y,_.z)}function f(_,b){let y=_*3;b.x=t[y+0],b.y=t[y+1],b.z=t[y+2]}function m(){let _=new C,b=new C,y=new C,M=new C,S=new Rt,v=new Rt,w=new Rt;for(let E=0,R=0;E<r.length;E+=9,R+=6){_.set(r[E+0],r[E+1],r[E+2]),b.set(r[E+3],r[E+4],r[E+5]),y.set(r[E+6],r[E+7],r[E+8]),S.set(o[R+0],o[R+1]),v.set(o[R+2],o[R+3]),w.set(o[R+4],o[R+5]),M.copy(_).add(b).add(y).divideScalar(3);let L=p(M);x(S,R+0,_,L),x(v,R+2,b,L),x(w,R+4,y,L)}}function x(_,b,y,M){M<0&&_.x===1&&(o[b]=_.x-1),y.x===0&&y.z===0&&(o[b]=M/2/Math.PI+.5)}function p(_){return Math.atan2(_.z,-_.x)}function g(_){return Math.atan2(-_.y,Math.sqrt(_.x*_.x+_.z*_.z))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.vertices,t.indices,t.radius,t.detail)}};function I0(s,t,e=2){let i=t&&t.length,n=i?t[0]*e:s.length,r=lp(s,0,n,e,!0),o=[];if(!r||r.next===r.prev)return o;let a,l,c;if(i&&(r=k0(s,t,r,e)),s.length>80*e){a=s[0],l=s[1];let h=a,u=l;for(let d=e;d<n;d+=e){let f=s[d],m=s[d+1];f<a&&(a=f),m<l&&(l=m),f>h&&(h=f),m>u&&(u=m)}c=Math.max(h-a,u-l),c=c!==0?32767/c:0}return fo(r,o,e,a,l,c,0),o}function lp(s,t,e,i,n){let r;if(n===j0(s,t,e,i)>0)for(let o=t;o<e;o+=i)r=of(o/i|0,s[o],s[o+1],r);else for(let o=e-i;o>=t;o-=i)r=of(o/i|0,s[o],s[o+1],r);return r&&gr(r,r.next)&&(mo(r),r=r.next),r}function Ss(s,t){if(!s)return s;t||(t=s);let e=s,i;do if(i=!1,!e.steiner&&(gr(e,e.next)||we(e.prev,e,e.next)===0)){if(mo(e),e=t=e.prev,e===e.next)break;i=!0}else e=e.next;while(i||e!==t);return t}function fo(s,t,e,i,n,r,o){if(!s)return;!o&&r&&V0(s,i,n,r);let a=s;for(;s.prev!==s.next;){let l=s.prev,c=s.next;if(r?N0(s,i,n,r):L0(s)){t.push(l.i,s.i,c.i),mo(s),s=c.next,a=c.next;continue}if(s=c,s===a){o?o===1?(s=D0(Ss(s),t),fo(s,t,e,i,n,r,2)):o===2&&z0(s,t,e,i,n,r):fo(Ss(s),t,e,i,n,r,1);break}}}function L0(s){let t=s.prev,e=s,i=s.next;if(we(t,e,i)>=0)return!1;let n=t.x,r=e.x,o=i.x,a=t.y,l=e.y,c=i.y,h=Math.min(n,r,o),u=Math.min(a,l,c),d=Math.max(n,r,o),f=Math.max(a,l,c),m=i.next;for(;m!==t;){if(m.x>=h&&m.x<=d&&m.y>=u&&m.y<=f&&Yr(n,a,r,l,o,c,m.x,m.y)&&we(m.prev,m,m.next)>=0)return!1;m=m.next}return!0}function N0(s,t,e,i){let n=s.prev,r=s,o=s.next;if(we(n,r,o)>=0)return!1;let a=n.x,l=r.x,c=o.x,h=n.y,u=r.y,d=o.y,f=Math.min(a,l,c),m=Math.min(h,u,d),x=Math.max(a,l,c),p=Math.max(h,u,d),g=kh(f,m,t,e,i),_=kh(x,p,t,e,i),b=s.prevZ,y=s.nextZ;for(;b&&b.z>=g&&y&&y.z<=_;){if(b.x>=f&&b.x<=x&&b.y>=m&&b.y<=p&&b!==n&&b!==o&&Yr(a,h,l,u,c,d,b.x,b.y)&&we(b.prev,b,b.next)>=0||(b=b.prevZ,y.x>=f&&y.x<=x&&y.y>=m&&y.y<=p&&y!==n&&y!==o&&Yr(a,h,l,u,c,d,y.x,y.y)&&we(y.prev,y,y.next)>=0))return!1;y=y.nextZ}for(;b&&b.z>=g;){if(b.x>=f&&b.x<=x&&b.y>=m&&b.y<=p&&b!==n&&b!==o&&Yr(a,h,l,u,c,d,b.x,b.y)&&we(b.prev,b,b.next)>=0)return!1;b=b.prevZ}for(;y&&y.z<=_;){if(y.x>=f&&y.x<=x&&y.y>=m&&y.y<=p&&y!==n&&y!==o&&Yr(a,h,l,u,c,d,y.x,y.y)&&we(y.prev,y,y.next)>=0)return!1;y=y.nextZ}return!0}function D0(s,t){let e=s;do{let i=e.prev,n=e.next.next;!gr(i,n)&&hp(i,e,e.next,n)&&po(i,n)&&po(n,i)&&(t.push(i.i,e.i,n.i),mo(e),mo(e.next),e=s=n),e=e.next}while(e!==s);return Ss(e)}function z0(s,t,e,i,n,r){let o=s;do{let a=o.next.next;for(;a!==o.prev;){if(o.i!==a.i&&W0(o,a)){let l=up(o,a);o=Ss(o,o.next),l=Ss(l,l.next),fo(o,t,e,i,n,r,0),fo(l,t,e,i,n,r,0);return}a=a.next}o=o.next}while(o!==s)}function k0(s,t,e,i){let n=[];for(let r=0,o=t.length;r<o;r++){let a=t[r]*i,l=r<o-1?t[r+1]*i:s.length,c=lp(s,a,l,i,!1);c===c.next&&(c.steiner=!0),n.push(G0(c))}n.sort(F0);for(let r=0;r<n.length;r++)e=O0(n[r],e);return e}function F0(s,t){let e=s.x-t.x;if(e===0&&(e=s.y-t.y,e===0)){let i=(s.next.y-s.y)/(s.next.x-s.x),n=(t.next.y-t.y)/(t.next.x-t.x);e=i-n}return e}function O0(s,t){let e=U0(s,t);if(!e)return t;let i=up(e,s);return Ss(i,i.next),Ss(e,e.next)}function U0(s,t){let e=t,i=s.x,n=s.y,r=-1/0,o;if(gr(s,e))return e;do{if(gr(s,e.next))return e.next;if(n<=e.y&&n>=e.next.y&&e.next.y!==e.y){let u=e.x+(n-e.y)*(e.next.x-e.x)/(e.next.y-e.y);if(u<=i&&u>r&&(r=u,o=e.x<e.next.x?e:e.next,u===i))return o}e=e.next}while(e!==t);if(!o)return null;let a=o,l=o.x,c=o.y,h=1/0;e=o;do{if(i>=e.x&&e.x>=l&&i!==e.x&&cp(n<c?i:r,n,l,c,n<c?r:i,n,e.x,e.y)){let u=Math.abs(n-e.y)/(i-e.x);po(e,s)&&(u<h||u===h&&(e.x>o.x||e.x===o.x&&B0(o,e)))&&(o=e,h=u)}e=e.next}while(e!==a);return o}function B0(s,t){return we(s.prev,s,t.prev)<0&&we(t.next,s,s.next)<0}function V0(s,t,e,i){let n=s;do n.z===0&&(n.z=kh(n.x,n.y,t,e,i)),n.prevZ=n.prev,n.nextZ=n.next,n=n.next;while(n!==s);n.prevZ.nextZ=null,n.prevZ=null,H0(n)}function H0(s){let t,e=1;do{let i=s,n;s=null;let r=null;for(t=0;i;){t++;let o=i,a=0;for(let c=0;c<e&&(a++,o=o.nextZ,!!o);c++);let l=e;for(;a>0||l>0&&o;)a!==0&&(l===0||!o||i.z<=o.z)?(n=i,i=i.nextZ,a--):(n=o,o=o.nextZ,l--),r?r.nextZ=n:s=n,n.prevZ=r,r=n;i=o}r.nextZ=null,e*=2}while(t>1);return s}function kh(s,t,e,i,n){return s=(s-e)*n|0,t=(t-i)*n|0,s=(s|s<<8)&16711935,s=(s|s<<4)&252645135,s=(s|s<<2)&858993459,s=(s|s<<1)&1431655765,t=(t|t<<8)&16711935,t=(t|t<<4)&252645135,t=(t|t<<2)&858993459,t=(t|t<<1)&1431655765,s|t<<1}function G0(s){let t=s,e=s;do(t.x<e.x||t.x===e.x&&t.y<e.y)&&(e=t),t=t.next;while(t!==s);return e}function cp(s,t,e,i,n,r,o,a){return(n-o)*(t-a)>=(s-o)*(r-a)&&(s-o)*(i-a)>=(e-o)*(t-a)&&(e-o)*(r-a)>=(n-o)*(i-a)}function Yr(s,t,e,i,n,r,o,a){return!(s===o&&t===a)&&cp(s,t,e,i,n,r,o,a)}function W0(s,t){return s.next.i!==t.i&&s.prev.i!==t.i&&!X0(s,t)&&(po(s,t)&&po(t,s)&&q0(s,t)&&(we(s.prev,s,t.prev)||we(s,t.prev,t))||gr(s,t)&&we(s.prev,s,s.next)>0&&we(t.prev,t,t.next)>0)}function we(s,t,e){return(t.y-s.y)*(e.x-t.x)-(t.x-s.x)*(e.y-t.y)}function gr(s,t){return s.x===t.x&&s.y===t.y}function hp(s,t,e,i){let n=Ca(we(s,t,e)),r=Ca(we(s,t,i)),o=Ca(we(e,i,s)),a=Ca(we(e,i,t));return!!(n!==r&&o!==a||n===0&&Ra(s,e,t)||r===0&&Ra(s,i,t)||o===0&&Ra(e,s,i)||a===0&&Ra(e,t,i))}function Ra(s,t,e){return t.x<=Math.max(s.x,e.x)&&t.x>=Math.min(s.x,e.x)&&t.y<=Math.max(s.y,e.y)&&t.y>=Math.min(s.y,e.y)}function Ca(s){return s>0?1:s<0?-1:0}function X0(s,t){let e=s;do{if(e.i!==s.i&&e.next.i!==s.i&&e.i!==t.i&&e.next.i!==t.i&&hp(e,e.next,s,t))return!0;e=e.next}while(e!==s);return!1}function po(s,t){return we(s.prev,s,s.next)<0?we(s,t,s.next)>=0&&we(s,s.prev,t)>=0:we(s,t,s.prev)<0||we(s,s.next,t)<0}function q0(s,t){let e=s,i=!1,n=(s.x+t.x)/2,r=(s.y+t.y)/2;do e.y>r!=e.next.y>r&&e.next.y!==e.y&&n<(e.next.x-e.x)*(r-e.y)/(e.next.y-e.y)+e.x&&(i=!i),e=e.next;while(e!==s);return i}function up(s,t){let e=Fh(s.i,s.x,s.y),i=Fh(t.i,t.x,t.y),n=s.next,r=t.prev;return s.next=t,t.prev=s,e.next=n,n.prev=e,i.next=e,e.prev=i,r.next=i,i.prev=r,i}function of(s,t,e,i){let n=Fh(s,t,e);return i?(n.next=i.next,n.prev=i,i.next.prev=n,i.next=n):(n.prev=n,n.next=n),n}function mo(s){s.next.prev=s.prev,s.prev.next=s.next,s.prevZ&&(s.prevZ.nextZ=s.nextZ),s.nextZ&&(s.nextZ.prevZ=s.prevZ)}function Fh(s,t,e){return{i:s,x:t,y:e,prev:null,next:null,z:0,prevZ:null,nextZ:null,steiner:!1}}function j0(s,t,e,i){let n=0;for(let r=t,o=e-i;r<e;r+=i)n+=(s[o]-s[r])*(s[r+1]+s[o+1]),o=r;return n}var Oh=class{static triangulate(t,e,i=2){return I0(t,e,i)}},xr=class s{static area(t){let e=t.length,i=0;for(let n=e-1,r=0;r<e;n=r++)i+=t[n].x*t[r].y-t[r].x*t[n].y;return i*.5}static isClockWise(t){return s.area(t)<0}static triangulateShape(t,e){let i=[],n=[],r=[];af(t),lf(i,t);let o=t.length;e.forEach(af);for(let l=0;l<e.length;l++)n.push(o),o+=e[l].length,lf(i,e[l]);let a=Oh.triangulate(i,n);for(let l=0;l<a.length;l+=3)r.push(a.slice(l,l+3));return r}};function af(s){let t=s.length;t>2&&s[t-1].equals(s[0])&&s.pop()}function lf(s,t){for(let e=0;e<t.length;e++)s.push(t[e].x),s.push(t[e].y)}var Xn=class s extends $a{constructor(t=1,e=0){let i=[1,0,0,-1,0,0,0,1,0,0,-1,0,0,0,1,0,0,-1],n=[0,2,4,0,4,3,0,3,5,0,5,2,1,2,5,1,5,3,1,3,4,1,4,2];super(i,n,t,e),this.type="OctahedronGeometry",this.parameters={radius:t,detail:e}}static fromJSON(t){return new s(t.radius,t.detail)}},ws=class s extends ce{constructor(t=1,e=1,i=1,n=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:i,heightSegments:n};let r=t/2,o=e/2,a=Math.floor(i),l=Math.floor(n),c=a+1,h=l+1,u=t/a,d=e/l,f=[],m=[],x=[],p=[];for(let g=0;g<h;g++){let _=g*d-o;for(let b=0;b<c;b++){let y=b*u-r;m.push(y,-_,0),x.push(0,0,1),p.push(b/a),p.push(1-g/l)}}for(let g=0;g<l;g++)for(let _=0;_<a;_++){let b=_+c*g,y=_+c*(g+1),M=_+1+c*(g+1),S=_+1+c*g;f.push(b,y,S),f.push(y,M,S)}this.setIndex(f),this.setAttribute("position",new Ft(m,3)),this.setAttribute("normal",new Ft(x,3)),this.setAttribute("uv",new Ft(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.width,t.height,t.widthSegments,t.heightSegments)}};var Cn=class s extends ce{constructor(t=1,e=32,i=16,n=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:i,phiStart:n,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),i=Math.max(2,Math.floor(i));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new C,d=new C,f=[],m=[],x=[],p=[];for(let g=0;g<=i;g++){let _=[],b=g/i,y=o+b*a,M=t*Math.cos(y),S=Math.sqrt(t*t-M*M),v=0;g===0&&o===0?v=.5/e:g===i&&l===Math.PI&&(v=-.5/e);for(let w=0;w<=e;w++){let E=w/e,R=n+E*r;u.x=-S*Math.cos(R),u.y=M,u.z=S*Math.sin(R),m.push(u.x,u.y,u.z),d.copy(u).normalize(),x.push(d.x,d.y,d.z),p.push(E+v,1-b),_.push(c++)}h.push(_)}for(let g=0;g<i;g++)for(let _=0;_<e;_++){let b=h[g][_+1],y=h[g][_],M=h[g+1][_],S=h[g+1][_+1];(g!==0||o>0)&&f.push(b,y,S),(g!==i-1||l<Math.PI)&&f.push(y,M,S)}this.setIndex(f),this.setAttribute("position",new Ft(m,3)),this.setAttribute("normal",new Ft(x,3)),this.setAttribute("uv",new Ft(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}};var $i=class s extends ce{constructor(t=1,e=.4,i=12,n=48,r=Math.PI*2,o=0,a=Math.PI*2){super(),this.type="TorusGeometry",this.parameters={radius:t,tube:e,radialSegments:i,tubularSegments:n,arc:r,thetaStart:o,thetaLength:a},i=Math.floor(i),n=Math.floor(n);let l=[],c=[],h=[],u=[],d=new C,f=new C,m=new C;for(let x=0;x<=i;x++){let p=o+x/i*a;for(let g=0;g<=n;g++){let _=g/n*r;f.x=(t+e*Math.cos(p))*Math.cos(_),f.y=(t+e*Math.cos(p))*Math.sin(_),f.z=e*Math.sin(p),c.push(f.x,f.y,f.z),d.x=t*Math.cos(_),d.y=t*Math.sin(_),m.subVectors(f,d).normalize(),h.push(m.x,m.y,m.z),u.push(g/n),u.push(x/i)}}for(let x=1;x<=i;x++)for(let p=1;p<=n;p++){let g=(n+1)*x+p-1,_=(n+1)*(x-1)+p-1,b=(n+1)*(x-1)+p,y=(n+1)*x+p;l.push(g,_,y),l.push(_,b,y)}this.setIndex(l),this.setAttribute("position",new Ft(c,3)),this.setAttribute("normal",new Ft(h,3)),this.setAttribute("uv",new Ft(u,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.radius,t.tube,t.radialSegments,t.tubularSegments,t.arc,t.thetaStart,t.thetaLength)}};function Ds(s){let t={};for(let e in s){t[e]={};for(let i in s[e]){let n=s[e][i];if(cf(n))n.isRenderTargetTexture?(Pt("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][i]=null):t[e][i]=n.clone();else if(Array.isArray(n))if(cf(n[0])){let r=[];for(let o=0,a=n.length;o<a;o++)r[o]=n[o].clone();t[e][i]=r}else t[e][i]=n.slice();else t[e][i]=n}}return t}function ri(s){let t={};for(let e=0;e<s.length;e++){let i=Ds(s[e]);for(let n in i)t[n]=i[n]}return t}function cf(s){return s&&(s.isColor||s.isMatrix3||s.isMatrix4||s.isVector2||s.isVector3||s.isVector4||s.isTexture||s.isQuaternion)}function Y0(s){let t=[];for(let e=0;e<s.length;e++)t.push(s[e].clone());return t}function bu(s){let t=s.getRenderTarget();return t===null?s.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:Ht.workingColorSpace}var dp={clone:Ds,merge:ri},$0=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Z0=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,an=class extends mi{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=$0,this.fragmentShader=Z0,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Ds(t.uniforms),this.uniformsGroups=Y0(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let n in this.uniforms){let o=this.uniforms[n].value;o&&o.isTexture?e.uniforms[n]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[n]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[n]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[n]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[n]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[n]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[n]={type:"m4",value:o.toArray()}:e.uniforms[n]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let i={};for(let n in this.extensions)this.extensions[n]===!0&&(i[n]=!0);return Object.keys(i).length>0&&(e.extensions=i),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let i in t.uniforms){let n=t.uniforms[i];switch(this.uniforms[i]={},n.type){case"t":this.uniforms[i].value=e[n.value]||null;break;case"c":this.uniforms[i].value=new It().setHex(n.value);break;case"v2":this.uniforms[i].value=new Rt().fromArray(n.value);break;case"v3":this.uniforms[i].value=new C().fromArray(n.value);break;case"v4":this.uniforms[i].value=new ae().fromArray(n.value);break;case"m3":this.uniforms[i].value=new Ot().fromArray(n.value);break;case"m4":this.uniforms[i].value=new wt().fromArray(n.value);break;default:this.uniforms[i].value=n.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let i in t.extensions)this.extensions[i]=t.extensions[i];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},Za=class extends an{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var gi=class extends mi{constructor(t){super(),this.isMeshPhongMaterial=!0,this.type="MeshPhongMaterial",this.color=new It(16777215),this.specular=new It(1118481),this.shininess=30,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new It(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=No,this.normalScale=new Rt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Qe,this.combine=To,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.specular.copy(t.specular),this.shininess=t.shininess,this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}};var Ms=class extends mi{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new It(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new It(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=No,this.normalScale=new Rt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Qe,this.combine=To,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}},Ja=class extends mi{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=qf,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},Ka=class extends mi{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function Gn(s,t){return!s||s.constructor===t?s:typeof t.BYTES_PER_ELEMENT=="number"?new t(s):Array.prototype.slice.call(s)}function $r(s){return s!==void 0&&s.inTangents!==void 0&&s.outTangents!==void 0}function J0(s){function t(n,r){return s[n]-s[r]}let e=s.length,i=new Array(e);for(let n=0;n!==e;++n)i[n]=n;return i.sort(t),i}function hf(s,t,e){let i=s.length,n=new s.constructor(i);for(let r=0,o=0;o!==i;++r){let a=e[r]*t;for(let l=0;l!==t;++l)n[o++]=s[a+l]}return n}function K0(s,t,e,i){let n=1,r=s[0];for(;r!==void 0&&r[i]===void 0;)r=s[n++];if(r===void 0)return;let o=r[i];if(o!==void 0)if(Array.isArray(o))do o=r[i],o!==void 0&&(t.push(r.time),e.push(...o)),r=s[n++];while(r!==void 0);else if(o.toArray!==void 0)do o=r[i],o!==void 0&&(t.push(r.time),o.toArray(e,e.length)),r=s[n++];while(r!==void 0);else do o=r[i],o!==void 0&&(t.push(r.time),e.push(o)),r=s[n++];while(r!==void 0)}var qn=class{constructor(t,e,i,n){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=n!==void 0?n:new e.constructor(i),this.sampleValues=e,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,i=this._cachedIndex,n=e[i],r=e[i-1];i:{t:{let o;e:{n:if(!(t<n)){for(let a=i+2;;){if(n===void 0){if(t<r)break n;return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(r=n,n=e[++i],t<n)break t}o=e.length;break e}if(!(t>=r)){let a=e[1];t<a&&(i=2,r=a);for(let l=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===l)break;if(n=r,r=e[--i-1],t>=r)break t}o=i,i=0;break e}break i}for(;i<o;){let a=i+o>>>1;t<e[a]?o=a:i=a+1}if(n=e[i],r=e[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===void 0)return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,n)}return this.interpolate_(i,r,t,n)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,i=this.sampleValues,n=this.valueSize,r=t*n;for(let o=0;o!==n;++o)e[o]=i[r+o];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},Qa=class extends qn{constructor(t,e,i,n){super(t,e,i,n),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Lh,endingEnd:Lh}}intervalChanged_(t,e,i){let n=this.parameterPositions,r=t-2,o=t+1,a=n[r],l=n[o];if(a===void 0)switch(this.getSettings_().endingStart){case Nh:r=t,a=2*e-i;break;case Dh:r=n.length-2,a=e+n[r]-n[r+1];break;default:r=t,a=i}if(l===void 0)switch(this.getSettings_().endingEnd){case Nh:o=t,l=2*i-e;break;case Dh:o=1,l=i+n[1]-n[0];break;default:o=t-1,l=e}let c=(i-e)*.5,h=this.valueSize;this._weightPrev=c/(e-a),this._weightNext=c/(l-i),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(t,e,i,n){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,m=(i-e)/(n-e),x=m*m,p=x*m,g=-d*p+2*d*x-d*m,_=(1+d)*p+(-1.5-2*d)*x+(-.5+d)*m+1,b=(-1-f)*p+(1.5+f)*x+.5*m,y=f*p-f*x;for(let M=0;M!==a;++M)r[M]=g*o[h+M]+_*o[c+M]+b*o[l+M]+y*o[u+M];return r}},tl=class extends qn{constructor(t,e,i,n){super(t,e,i,n)}interpolate_(t,e,i,n){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=(i-e)/(n-e),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},el=class extends qn{constructor(t,e,i,n){super(t,e,i,n)}interpolate_(t){return this.copySampleValue_(t-1)}},il=class extends qn{interpolate_(t,e,i,n){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let m=(i-e)/(n-e),x=1-m;for(let p=0;p!==a;++p)r[p]=o[c+p]*x+o[l+p]*m;return r}let d=a*2,f=t-1;for(let m=0;m!==a;++m){let x=o[c+m],p=o[l+m],g=f*d+m*2,_=u[g],b=u[g+1],y=t*d+m*2,M=h[y],S=h[y+1],v=tx(i,e,_,M,n);r[m]=fp(v,x,b,S,p)}return r}};function fp(s,t,e,i,n){let r=1-s;return r*r*r*t+3*r*r*s*e+3*r*s*s*i+s*s*s*n}function Q0(s,t,e,i,n){let r=1-s;return 3*r*r*(e-t)+6*r*s*(i-e)+3*s*s*(n-i)}function tx(s,t,e,i,n){let r=(s-t)/(n-t);for(let o=0;o<8;o++){let a=fp(r,t,e,i,n)-s;if(Math.abs(a)<1e-10)break;let l=Q0(r,t,e,i,n);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var xi=class{constructor(t,e,i,n){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=Gn(e,this.TimeBufferType),this.values=Gn(i,this.ValueBufferType),this.setInterpolation(n||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,i;if(e.toJSON!==this.toJSON)i=e.toJSON(t);else{i={name:t.name,times:Gn(t.times,Array),values:Gn(t.values,Array)};let n=t.getInterpolation();n!==t.DefaultInterpolation&&(i.interpolation=n),$r(t.settings)&&(i.settings={inTangents:Gn(t.settings.inTangents,Array),outTangents:Gn(t.settings.outTangents,Array)})}return i.type=t.ValueTypeName,i}InterpolantFactoryMethodDiscrete(t){return new el(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new tl(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new Qa(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new il(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case xs:e=this.InterpolantFactoryMethodDiscrete;break;case Ha:e=this.InterpolantFactoryMethodLinear;break;case La:e=this.InterpolantFactoryMethodSmooth;break;case Qr:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return Pt("KeyframeTrack:",i),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return xs;case this.InterpolantFactoryMethodLinear:return Ha;case this.InterpolantFactoryMethodSmooth:return La;case this.InterpolantFactoryMethodBezier:return Qr}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let i=0,n=e.length;i!==n;++i)e[i]+=t;$r(this.settings)&&(uf(this.settings.inTangents,t),uf(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let i=0,n=e.length;i!==n;++i)e[i]*=t;$r(this.settings)&&(df(this.settings.inTangents,t),df(this.settings.outTangents,t))}return this}trim(t,e){let i=this.times,n=i.length,r=0,o=n-1;for(;r!==n&&i[r]<t;)++r;for(;o!==-1&&i[o]>e;)--o;if(++o,r!==0||o!==n){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=i.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(kt("KeyframeTrack: Invalid value size in track.",this),t=!1);let i=this.times,n=this.values,r=i.length;r===0&&(kt("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let l=i[a];if(typeof l=="number"&&isNaN(l)){kt("KeyframeTrack: Time is not a valid number.",this,a,l),t=!1;break}if(o!==null&&o>l){kt("KeyframeTrack: Out of order keys.",this,a,l,o),t=!1;break}o=l}if(n!==void 0&&$g(n))for(let a=0,l=n.length;a!==l;++a){let c=n[a];if(isNaN(c)){kt("KeyframeTrack: Value is not a valid number.",this,a,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),i=this.getValueSize(),n=this.getInterpolation()===La,r=t.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=t[a],h=t[a+1];if(c!==h&&(a!==1||c!==t[0]))if(n)l=!0;else{let u=a*i,d=u-i,f=u+i;for(let m=0;m!==i;++m){let x=e[u+m];if(x!==e[d+m]||x!==e[f+m]){l=!0;break}}}if(l){if(a!==o){t[o]=t[a];let u=a*i,d=o*i;for(let f=0;f!==i;++f)e[d+f]=e[u+f]}++o}}if(r>0){t[o]=t[r];for(let a=r*i,l=o*i,c=0;c!==i;++c)e[l+c]=e[a+c];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*i)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),i=this.constructor,n=new i(this.name,t,e);return n.createInterpolant=this.createInterpolant,$r(this.settings)&&(n.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),n}};function uf(s,t){for(let e=0,i=s.length;e!==i;e+=2)s[e]+=t}function df(s,t){for(let e=0,i=s.length;e!==i;e+=2)s[e]*=t}xi.prototype.ValueTypeName="";xi.prototype.TimeBufferType=Float32Array;xi.prototype.ValueBufferType=Float32Array;xi.prototype.DefaultInterpolation=Ha;var Pn=class extends xi{constructor(t,e,i){super(t,e,i)}};Pn.prototype.ValueTypeName="bool";Pn.prototype.ValueBufferType=Array;Pn.prototype.DefaultInterpolation=xs;Pn.prototype.InterpolantFactoryMethodLinear=void 0;Pn.prototype.InterpolantFactoryMethodSmooth=void 0;var go=class extends xi{constructor(t,e,i,n){super(t,e,i,n)}};go.prototype.ValueTypeName="color";var yr=class extends xi{constructor(t,e,i,n){super(t,e,i,n)}};yr.prototype.ValueTypeName="number";var nl=class extends qn{constructor(t,e,i,n){super(t,e,i,n)}interpolate_(t,e,i,n){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(i-e)/(n-e),c=t*a;for(let h=c+a;c!==h;c+=4)Wt.slerpFlat(r,0,o,c-a,o,c,l);return r}},ln=class extends xi{constructor(t,e,i,n){super(t,e,i,n)}InterpolantFactoryMethodLinear(t){return new nl(this.times,this.values,this.getValueSize(),t)}};ln.prototype.ValueTypeName="quaternion";ln.prototype.InterpolantFactoryMethodSmooth=void 0;var In=class extends xi{constructor(t,e,i){super(t,e,i)}};In.prototype.ValueTypeName="string";In.prototype.ValueBufferType=Array;In.prototype.DefaultInterpolation=xs;In.prototype.InterpolantFactoryMethodLinear=void 0;In.prototype.InterpolantFactoryMethodSmooth=void 0;var ii=class extends xi{constructor(t,e,i,n){super(t,e,i,n)}};ii.prototype.ValueTypeName="vector";var _r=class{constructor(t="",e=-1,i=[],n=Xf){this.name=t,this.tracks=i,this.duration=e,this.blendMode=n,this.uuid=Qn(),this.userData={},this.duration<0&&this.resetDuration()}static parse(t){let e=[],i=t.tracks,n=1/(t.fps||1);for(let o=0,a=i.length;o!==a;++o)e.push(ix(i[o]).scale(n));let r=new this(t.name,t.duration,e,t.blendMode);return r.uuid=t.uuid,r.userData=JSON.parse(t.userData||"{}"),r}static toJSON(t){let e=[],i=t.tracks,n={name:t.name,duration:t.duration,tracks:e,uuid:t.uuid,blendMode:t.blendMode,userData:JSON.stringify(t.userData)};for(let r=0,o=i.length;r!==o;++r)e.push(xi.toJSON(i[r]));return n}static CreateFromMorphTargetSequence(t,e,i,n){let r=e.length,o=[];for(let a=0;a<r;a++){let l=[],c=[];l.push((a+r-1)%r,a,(a+1)%r),c.push(0,1,0);let h=J0(l);l=hf(l,1,h),c=hf(c,1,h),!n&&l[0]===0&&(l.push(r),c.push(c[0])),o.push(new yr(".morphTargetInfluences["+e[a].name+"]",l,c).scale(1/i))}return new this(t,-1,o)}static findByName(t,e){let i=t;if(!Array.isArray(t)){let n=t;i=n.geometry&&n.geometry.animations||n.animations}for(let n=0;n<i.length;n++)if(i[n].name===e)return i[n];return null}static CreateClipsFromMorphTargetSequences(t,e,i){let n={},r=/^([\w-]*?)([\d]+)$/;for(let a=0,l=t.length;a<l;a++){let c=t[a],h=c.name.match(r);if(h&&h.length>1){let u=h[1],d=n[u];d||(n[u]=d=[]),d.push(c)}}let o=[];for(let a in n)o.push(this.CreateFromMorphTargetSequence(a,n[a],e,i));return o}resetDuration(){let t=this.tracks,e=0;for(let i=0,n=t.length;i!==n;++i){let r=this.tracks[i];e=Math.max(e,r.times[r.times.length-1])}return this.duration=e,this}trim(){for(let t=0;t<this.tracks.length;t++)this.tracks[t].trim(0,this.duration);return this}validate(){let t=!0;for(let e=0;e<this.tracks.length;e++)t=t&&this.tracks[e].validate();return t}optimize(){for(let t=0;t<this.tracks.length;t++)this.tracks[t].optimize();return this}clone(){let t=[];for(let i=0;i<this.tracks.length;i++)t.push(this.tracks[i].clone());let e=new this.constructor(this.name,this.duration,t,this.blendMode);return e.userData=JSON.parse(JSON.stringify(this.userData)),e}toJSON(){return this.constructor.toJSON(this)}};function ex(s){switch(s.toLowerCase()){case"scalar":case"double":case"float":case"number":case"integer":return yr;case"vector":case"vector2":case"vector3":case"vector4":return ii;case"color":return go;case"quaternion":return ln;case"bool":case"boolean":return Pn;case"string":return In}throw new Error("THREE.KeyframeTrack: Unsupported typeName: "+s)}function ix(s){if(s.type===void 0)throw new Error("THREE.KeyframeTrack: track type undefined, can not parse");let t=ex(s.type);if(s.times===void 0){let i=[],n=[];K0(s.keys,i,n,"value"),s.times=i,s.values=n}let e;return t.parse!==void 0?e=t.parse(s):e=new t(s.name,s.times,s.values,s.interpolation),$r(s.settings)&&(e.settings={inTangents:Gn(s.settings.inTangents,Float32Array),outTangents:Gn(s.settings.outTangents,Float32Array)}),e}var ar={enabled:!1,files:{},add:function(s,t){this.enabled!==!1&&(ff(s)||(this.files[s]=t))},get:function(s){if(this.enabled!==!1&&!ff(s))return this.files[s]},remove:function(s){delete this.files[s]},clear:function(){this.files={}}};function ff(s){try{let t=s.slice(s.indexOf(":")+1);return new URL(t).protocol==="blob:"}catch{return!1}}var jn=class{constructor(t,e,i){let n=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=i,this._abortController=null,this.itemStart=function(h){a++,r===!1&&n.onStart!==void 0&&n.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,n.onProgress!==void 0&&n.onProgress(h,o,a),o===a&&(r=!1,n.onLoad!==void 0&&n.onLoad())},this.itemError=function(h){n.onError!==void 0&&n.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],m=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return m}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},Xl=new jn,ni=class{constructor(t){this.manager=t!==void 0?t:Xl,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let i=this;return new Promise(function(n,r){i.load(t,n,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};ni.DEFAULT_MATERIAL_NAME="__DEFAULT";var Sn={},Uh=class extends Error{constructor(t,e){super(t),this.response=e}},zi=class extends ni{constructor(t){super(t),this.mimeType="",this.responseType="",this._abortController=new AbortController}load(t,e,i,n){t===void 0&&(t=""),this.path!==void 0&&(t=this.path+t),t=this.manager.resolveURL(t);let r=ar.get(`file:${t}`);if(r!==void 0){this.manager.itemStart(t),setTimeout(()=>{e&&e(r),this.manager.itemEnd(t)},0);return}if(Sn[t]!==void 0){Sn[t].push({onLoad:e,onProgress:i,onError:n});return}Sn[t]=[],Sn[t].push({onLoad:e,onProgress:i,onError:n});let o=new Request(t,{headers:new Headers(this.requestHeader),credentials:this.withCredentials?"include":"same-origin",priority:this.priority,cache:this.cache,signal:typeof AbortSignal.any=="function"?AbortSignal.any([this._abortController.signal,this.manager.abortController.signal]):this._abortController.signal}),a=this.mimeType,l=this.responseType;fetch(o).then(c=>{if(c.status===200||c.status===0){if(c.status===0&&Pt("FileLoader: HTTP Status 0 received."),typeof ReadableStream>"u"||c.body===void 0||c.body.getReader===void 0)return c;let h=Sn[t],u=c.body.getReader(),d=c.headers.get("X-File-Size")||c.headers.get("Content-Length"),f=d?parseInt(d):0,m=f!==0,x=0,p=new ReadableStream({start(g){_();function _(){u.read().then(({done:b,value:y})=>{if(b)g.close();else{x+=y.byteLength;let M=new ProgressEvent("progress",{lengthComputable:m,loaded:x,total:f});for(let S=0,v=h.length;S<v;S++){let w=h[S];w.onProgress&&w.onProgress(M)}g.enqueue(y),_()}},b=>{g.error(b)})}}});return new Response(p)}else throw new Uh(`fetch for "${c.url}" responded with ${c.status}: ${c.statusText}`,c)}).then(c=>{switch(l){case"arraybuffer":return c.arrayBuffer();case"blob":return c.blob();case"document":return c.text().then(h=>new DOMParser().parseFromString(h,a));case"json":return c.json();default:if(a==="")return c.text();{let u=/charset="?([^;"\s]*)"?/i.exec(a),d=u&&u[1]?u[1].toLowerCase():void 0,f=new TextDecoder(d);return c.arrayBuffer().then(m=>f.decode(m))}}}).then(c=>{ar.add(`file:${t}`,c);let h=Sn[t];delete Sn[t];for(let u=0,d=h.length;u<d;u++){let f=h[u];f.onLoad&&f.onLoad(c)}}).catch(c=>{let h=Sn[t];if(h===void 0)throw this.manager.itemError(t),c;delete Sn[t];for(let u=0,d=h.length;u<d;u++){let f=h[u];f.onError&&f.onError(c)}this.manager.itemError(t)}).finally(()=>{this.manager.itemEnd(t)}),this.manager.itemStart(t)}setResponseType(t){return this.responseType=t,this}setMimeType(t){return this.mimeType=t,this}abort(){return this._abortController.abort(),this._abortController=new AbortController,this}};var nr=new WeakMap,sl=class extends ni{constructor(t){super(t)}load(t,e,i,n){this.path!==void 0&&(t=this.path+t),t=this.manager.resolveURL(t);let r=this,o=ar.get(`image:${t}`);if(o!==void 0){if(o.complete===!0)r.manager.itemStart(t),setTimeout(function(){e&&e(o),r.manager.itemEnd(t)},0);else{let u=nr.get(o);u===void 0&&(u=[],nr.set(o,u)),u.push({onLoad:e,onError:n})}return o}let a=hr("img");function l(){h(),e&&e(this);let u=nr.get(this)||[];for(let d=0;d<u.length;d++){let f=u[d];f.onLoad&&f.onLoad(this)}nr.delete(this),r.manager.itemEnd(t)}function c(u){h(),n&&n(u),ar.remove(`image:${t}`);let d=nr.get(this)||[];for(let f=0;f<d.length;f++){let m=d[f];m.onError&&m.onError(u)}nr.delete(this),r.manager.itemError(t),r.manager.itemEnd(t)}function h(){a.removeEventListener("load",l,!1),a.removeEventListener("error",c,!1)}return a.addEventListener("load",l,!1),a.addEventListener("error",c,!1),t.slice(0,5)!=="data:"&&this.crossOrigin!==void 0&&(a.crossOrigin=this.crossOrigin),ar.add(`image:${t}`,a),r.manager.itemStart(t),a.fetchPriority=this.priority,a.src=t,a}};var xo=class extends ni{constructor(t){super(t)}load(t,e,i,n){let r=this,o=new vs,a=new zi(this.manager);return a.setPriority(this.priority),a.setCache(this.cache),a.setResponseType("arraybuffer"),a.setRequestHeader(this.requestHeader),a.setPath(this.path),a.setWithCredentials(r.withCredentials),a.load(t,function(l){let c;try{c=r.parse(l)}catch(h){n!==void 0?n(h):kt(h);return}r._applyTexData(o,c),e&&e(o,c)},i,n),o}createDataTexture(t){let e=new vs;return this._applyTexData(e,this.parse(t)),e}_applyTexData(t,e){e.image!==void 0?t.image=e.image:e.data!==void 0&&(t.image.width=e.width,t.image.height=e.height,t.image.data=e.data),t.wrapS=e.wrapS!==void 0?e.wrapS:ci,t.wrapT=e.wrapT!==void 0?e.wrapT:ci,t.magFilter=e.magFilter!==void 0?e.magFilter:Ve,t.minFilter=e.minFilter!==void 0?e.minFilter:Ve,t.anisotropy=e.anisotropy!==void 0?e.anisotropy:1,e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.mipmaps!==void 0&&(t.mipmaps=e.mipmaps,t.minFilter=ki),e.mipmapCount===1&&(t.minFilter=Ve),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),t.needsUpdate=!0}},Ts=class extends ni{constructor(t){super(t)}load(t,e,i,n){let r=new hi,o=new sl(this.manager);return o.setPriority(this.priority),o.setCache(this.cache),o.setCrossOrigin(this.crossOrigin),o.setPath(this.path),o.load(t,function(a){r.image=a,r.needsUpdate=!0,e!==void 0&&e(r)},i,n),r}},Yn=class extends te{static registerNode(t){this.prototype._lightNode=t}constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new It(t),this.intensity=e}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,e}},yo=class extends Yn{constructor(t,e,i){super(t,i),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(te.DEFAULT_UP),this.updateMatrix(),this.groundColor=new It(e)}copy(t,e){return super.copy(t,e),this.groundColor.copy(t.groundColor),this}toJSON(t){let e=super.toJSON(t);return e.object.groundColor=this.groundColor.getHex(),e}},Ph=new wt,pf=new C,mf=new C,vr=class{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new Rt(512,512),this.mapType=yi,this.map=null,this.mapPass=null,this.matrix=new wt,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Wn,this._frameExtents=new Rt(1,1),this._viewportCount=1,this._viewports=[new ae(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(t){let e=this.camera;pf.setFromMatrixPosition(t.matrixWorld),e.position.copy(pf),mf.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(mf),e.updateMatrixWorld(),this._updateMatrix(e,this.matrix,this._frustum)}_updateMatrix(t,e,i,n){Ph.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse),i.setFromProjectionMatrix(Ph,t.coordinateSystem,t.reversedDepth);let r=this._frameExtents,o=n?n.z/r.x:1,a=n?n.w/r.y:1,l=n?n.x/r.x:0,c=n?n.y/r.y:0;t.coordinateSystem===cr||t.reversedDepth?e.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):e.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),e.multiply(Ph)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.autoUpdate=t.autoUpdate,this.needsUpdate=t.needsUpdate,this.normalBias=t.normalBias,this.blurSamples=t.blurSamples,this.mapSize.copy(t.mapSize),this.mapType=t.mapType,this.biasNode=t.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return t.intensity=this.intensity,t.bias=this.bias,t.normalBias=this.normalBias,t.radius=this.radius,t.blurSamples=this.blurSamples,t.mapSize=this.mapSize.toArray(),t.mapType=this.mapType,t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}},Pa=new C,Ia=new Wt,nn=new C,_o=class extends te{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new wt,this.projectionMatrix=new wt,this.projectionMatrixInverse=new wt,this.coordinateSystem=Di,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(Pa,Ia,nn),nn.x===1&&nn.y===1&&nn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Pa,Ia,nn.set(1,1,1)).invert()}updateWorldMatrix(t,e,i=!1){super.updateWorldMatrix(t,e,i),this.matrixWorld.decompose(Pa,Ia,nn),nn.x===1&&nn.y===1&&nn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Pa,Ia,nn.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},Hn=new C,gf=new Rt,xf=new Rt,Ce=class extends _o{constructor(t=50,e=1,i=.1,n=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=i,this.far=n,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=ys*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(Jr*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return ys*2*Math.atan(Math.tan(Jr*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,i){Hn.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(Hn.x,Hn.y).multiplyScalar(-t/Hn.z),Hn.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(Hn.x,Hn.y).multiplyScalar(-t/Hn.z)}getViewSize(t,e){return this.getViewBounds(t,gf,xf),e.subVectors(xf,gf)}setViewOffset(t,e,i,n,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=n,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(Jr*.5*this.fov)/this.zoom,i=2*e,n=this.aspect*i,r=-.5*n,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*n/l,e-=o.offsetY*i/c,n*=o.width/l,i*=o.height/c}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+n,e,e-i,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}},Bh=class extends vr{constructor(){super(new Ce(50,1,.5,500)),this.isSpotLightShadow=!0,this.focus=1,this.aspect=1}updateMatrices(t){let e=this.camera,i=ys*2*t.angle*this.focus,n=this.mapSize.width/this.mapSize.height*this.aspect,r=t.distance||e.far;(i!==e.fov||n!==e.aspect||r!==e.far)&&(e.fov=i,e.aspect=n,e.far=r,e.updateProjectionMatrix()),super.updateMatrices(t)}copy(t){return super.copy(t),this.focus=t.focus,this.aspect=t.aspect,this}toJSON(){let t=super.toJSON();return t.focus=this.focus,t.aspect=this.aspect,t}},vo=class extends Yn{constructor(t,e,i=0,n=Math.PI/3,r=0,o=2){super(t,e),this.isSpotLight=!0,this.type="SpotLight",this.position.copy(te.DEFAULT_UP),this.updateMatrix(),this.target=new te,this.distance=i,this.angle=n,this.penumbra=r,this.decay=o,this.map=null,this.shadow=new Bh}get power(){return this.intensity*Math.PI}set power(t){this.intensity=t/Math.PI}dispose(){super.dispose(),this.shadow.dispose()}copy(t,e){return super.copy(t,e),this.distance=t.distance,this.angle=t.angle,this.penumbra=t.penumbra,this.decay=t.decay,this.target=t.target.clone(),this.map=t.map,this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.distance=this.distance,e.object.angle=this.angle,e.object.decay=this.decay,e.object.penumbra=this.penumbra,e.object.target=this.target.uuid,this.map&&this.map.isTexture&&(e.object.map=this.map.toJSON(t).uuid),e.object.shadow=this.shadow.toJSON(),e}},Vh=class extends vr{constructor(){super(new Ce(90,1,.5,500)),this.isPointLightShadow=!0}},bo=class extends Yn{constructor(t,e,i=0,n=2){super(t,e),this.isPointLight=!0,this.type="PointLight",this.distance=i,this.decay=n,this.shadow=new Vh}get power(){return this.intensity*4*Math.PI}set power(t){this.intensity=t/(4*Math.PI)}dispose(){super.dispose(),this.shadow.dispose()}copy(t,e){return super.copy(t,e),this.distance=t.distance,this.decay=t.decay,this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.distance=this.distance,e.object.decay=this.decay,e.object.shadow=this.shadow.toJSON(),e}},As=class extends _o{constructor(t=-1,e=1,i=1,n=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=i,this.bottom=n,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,i,n,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=n,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,n=(this.top+this.bottom)/2,r=i-t,o=i+t,a=n+e,l=n-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}},Hh=class extends vr{constructor(){super(new As(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},$n=class extends Yn{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(te.DEFAULT_UP),this.updateMatrix(),this.target=new te,this.shadow=new Hh}dispose(){super.dispose(),this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.shadow=this.shadow.toJSON(),e.object.target=this.target.uuid,e}},Es=class extends Yn{constructor(t,e){super(t,e),this.isAmbientLight=!0,this.type="AmbientLight"}};var Rs=class{static extractUrlBase(t){let e=t.lastIndexOf("/");return e===-1?"./":t.slice(0,e+1)}static resolveURL(t,e){return typeof t!="string"||t===""?"":(/^https?:\/\//i.test(e)&&/^\//.test(t)&&(e=e.replace(/(^https?:\/\/[^\/]+).*/i,"$1")),/^(https?:)?\/\//i.test(t)||/^data:.*,.*$/i.test(t)||/^blob:.*$/i.test(t)?t:e+t)}};var sr=-90,rr=1,br=class extends te{constructor(t,e,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let n=new Ce(sr,rr,t,e);n.layers=this.layers,this.add(n);let r=new Ce(sr,rr,t,e);r.layers=this.layers,this.add(r);let o=new Ce(sr,rr,t,e);o.layers=this.layers,this.add(o);let a=new Ce(sr,rr,t,e);a.layers=this.layers,this.add(a);let l=new Ce(sr,rr,t,e);l.layers=this.layers,this.add(l);let c=new Ce(sr,rr,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[i,n,r,o,a,l]=e;for(let c of e)this.remove(c);if(t===Di)i.up.set(0,1,0),i.lookAt(1,0,0),n.up.set(0,1,0),n.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===cr)i.up.set(0,-1,0),i.lookAt(-1,0,0),n.up.set(0,-1,0),n.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:n}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=t.getRenderTarget(),d=t.getActiveCubeFace(),f=t.getActiveMipmapLevel(),m=t.xr.enabled;t.xr.enabled=!1;let x=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let p=!1;t.isWebGLRenderer===!0?p=t.state.buffers.depth.getReversed():p=t.reversedDepthBuffer,t.setRenderTarget(i,0,n),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(i,1,n),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(i,2,n),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(i,3,n),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),t.setRenderTarget(i,4,n),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),i.texture.mipmapsAutoUpdate=x,t.setRenderTarget(i,5,n),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,d,f),t.xr.enabled=m,i.texture.needsPMREMUpdate=!0}},rl=class extends Ce{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var Su="\\[\\]\\.:\\/",nx=new RegExp("["+Su+"]","g"),wu="[^"+Su+"]",sx="[^"+Su.replace("\\.","")+"]",rx=/((?:WC+[\/:])*)/.source.replace("WC",wu),ox=/(WCOD+)?/.source.replace("WCOD",sx),ax=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",wu),lx=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",wu),cx=new RegExp("^"+rx+ox+ax+lx+"$"),hx=["material","materials","bones","map"],Gh=class{constructor(t,e,i){let n=i||pe.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,n)}getValue(t,e){this.bind();let i=this._targetGroup.nCachedObjects_,n=this._bindings[i];n!==void 0&&n.getValue(t,e)}setValue(t,e){let i=this._bindings;for(let n=this._targetGroup.nCachedObjects_,r=i.length;n!==r;++n)i[n].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].unbind()}},pe=class s{constructor(t,e,i){this.path=e,this.parsedPath=i||s.parseTrackName(e),this.node=s.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,i){return t&&t.isAnimationObjectGroup?new s.Composite(t,e,i):new s(t,e,i)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(nx,"")}static parseTrackName(t){let e=cx.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let i={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},n=i.nodeName&&i.nodeName.lastIndexOf(".");if(n!==void 0&&n!==-1){let r=i.nodeName.substring(n+1);hx.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,n),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return i}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let i=t.skeleton.getBoneByName(e);if(i!==void 0)return i}if(t.children){let i=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let l=i(a.children);if(l)return l}return null},n=i(t.children);if(n)return n}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let i=this.resolvedProperty;for(let n=0,r=i.length;n!==r;++n)t[e++]=i[n]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let i=this.resolvedProperty;for(let n=0,r=i.length;n!==r;++n)i[n]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let i=this.resolvedProperty;for(let n=0,r=i.length;n!==r;++n)i[n]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let i=this.resolvedProperty;for(let n=0,r=i.length;n!==r;++n)i[n]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,i=e.objectName,n=e.propertyName,r=e.propertyIndex;if(t||(t=s.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){Pt("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let c=e.objectIndex;switch(i){case"materials":if(!t.material){kt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){kt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){kt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===c){c=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){kt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){kt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[i]===void 0){kt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[i]}if(c!==void 0){if(t[c]===void 0){kt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let o=t[n];if(o===void 0){let c=e.nodeName;kt("PropertyBinding: Trying to update property for track: "+c+"."+n+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(n==="morphTargetInfluences"){if(!t.geometry){kt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){kt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=n;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};pe.Composite=Gh;pe.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};pe.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};pe.prototype.GetterByBindingType=[pe.prototype._getValue_direct,pe.prototype._getValue_array,pe.prototype._getValue_arrayElement,pe.prototype._getValue_toArray];pe.prototype.SetterByBindingTypeAndVersioning=[[pe.prototype._setValue_direct,pe.prototype._setValue_direct_setNeedsUpdate,pe.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[pe.prototype._setValue_array,pe.prototype._setValue_array_setNeedsUpdate,pe.prototype._setValue_array_setMatrixWorldNeedsUpdate],[pe.prototype._setValue_arrayElement,pe.prototype._setValue_arrayElement_setNeedsUpdate,pe.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[pe.prototype._setValue_fromArray,pe.prototype._setValue_fromArray_setNeedsUpdate,pe.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var dT=new Float32Array(1);var yf=new wt,So=class{constructor(t,e,i=0,n=1/0){this.ray=new on(t,e),this.near=i,this.far=n,this.camera=null,this.layers=new fr,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):kt("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return yf.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(yf),this}intersectObject(t,e=!0,i=[]){return Wh(t,this,i,e),i.sort(_f),i}intersectObjects(t,e=!0,i=[]){for(let n=0,r=t.length;n<r;n++)Wh(t[n],this,i,e);return i.sort(_f),i}};function _f(s,t){return s.distance-t.distance}function Wh(s,t,e,i){let n=!0;if(s.layers.test(t.layers)&&s.raycast(t,e)===!1&&(n=!1),n===!0&&i===!0){let r=s.children;for(let o=0,a=r.length;o<a;o++)Wh(r[o],t,e,!0)}}var Sr=class{constructor(t=1,e=0,i=0){this.radius=t,this.phi=e,this.theta=i}set(t,e,i){return this.radius=t,this.phi=e,this.theta=i,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=jt(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,i){return this.radius=Math.sqrt(t*t+e*e+i*i),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,i),this.phi=Math.acos(jt(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var Xh=class{static{this.prototype.isMatrix2=!0}constructor(t,e,i,n){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,i,n)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let i=0;i<4;i++)this.elements[i]=t[i+e];return this}set(t,e,i,n){let r=this.elements;return r[0]=t,r[2]=e,r[1]=i,r[3]=n,this}};var wo=class extends An{constructor(t=10,e=10,i=4473924,n=8947848){i=new It(i),n=new It(n);let r=e/2,o=t/e,a=t/2,l=[],c=[];for(let d=0,f=0,m=-a;d<=e;d++,m+=o){l.push(-a,0,m,a,0,m),l.push(m,0,-a,m,0,a);let x=d===r?i:n;x.toArray(c,f),f+=3,x.toArray(c,f),f+=3,x.toArray(c,f),f+=3,x.toArray(c,f),f+=3}let h=new ce;h.setAttribute("position",new Ft(l,3)),h.setAttribute("color",new Ft(c,3));let u=new ei({vertexColors:!0,toneMapped:!1});super(h,u),this.type="GridHelper"}dispose(){super.dispose(),this.geometry.dispose(),this.material.dispose()}};var Cs=class extends ji{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function Mu(s,t,e,i){let n=ux(i);switch(e){case hu:return s*t;case du:return s*t/n.components*n.byteLength;case dl:return s*t/n.components*n.byteLength;case Kn:return s*t*2/n.components*n.byteLength;case fl:return s*t*2/n.components*n.byteLength;case uu:return s*t*3/n.components*n.byteLength;case Oi:return s*t*4/n.components*n.byteLength;case pl:return s*t*4/n.components*n.byteLength;case Eo:case Ro:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*8;case Co:case Po:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*16;case gl:case yl:return Math.max(s,16)*Math.max(t,8)/4;case ml:case xl:return Math.max(s,8)*Math.max(t,8)/2;case _l:case vl:case Sl:case wl:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*8;case bl:case Io:case Ml:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*16;case Tl:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*16;case Al:return Math.floor((s+4)/5)*Math.floor((t+3)/4)*16;case El:return Math.floor((s+4)/5)*Math.floor((t+4)/5)*16;case Rl:return Math.floor((s+5)/6)*Math.floor((t+4)/5)*16;case Cl:return Math.floor((s+5)/6)*Math.floor((t+5)/6)*16;case Pl:return Math.floor((s+7)/8)*Math.floor((t+4)/5)*16;case Il:return Math.floor((s+7)/8)*Math.floor((t+5)/6)*16;case Ll:return Math.floor((s+7)/8)*Math.floor((t+7)/8)*16;case Nl:return Math.floor((s+9)/10)*Math.floor((t+4)/5)*16;case Dl:return Math.floor((s+9)/10)*Math.floor((t+5)/6)*16;case zl:return Math.floor((s+9)/10)*Math.floor((t+7)/8)*16;case kl:return Math.floor((s+9)/10)*Math.floor((t+9)/10)*16;case Fl:return Math.floor((s+11)/12)*Math.floor((t+9)/10)*16;case Ol:return Math.floor((s+11)/12)*Math.floor((t+11)/12)*16;case Ul:case Bl:case Vl:return Math.ceil(s/4)*Math.ceil(t/4)*16;case Hl:case Gl:return Math.ceil(s/4)*Math.ceil(t/4)*8;case Lo:case Wl:return Math.ceil(s/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function ux(s){switch(s){case yi:case ou:return{byteLength:1,components:1};case Ar:case au:case Ji:return{byteLength:2,components:1};case hl:case ul:return{byteLength:2,components:4};case Zi:case cl:case Fi:return{byteLength:4,components:1};case lu:case cu:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${s}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Pt("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function zp(){let s=null,t=!1,e=null,i=null;function n(r,o){i=s.requestAnimationFrame(n),e(r,o)}return{start:function(){t!==!0&&e!==null&&s!==null&&(i=s.requestAnimationFrame(n),t=!0)},stop:function(){s!==null&&s.cancelAnimationFrame(i),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){s=r}}}function fx(s){let t=new WeakMap;function e(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=s.createBuffer();s.bindBuffer(l,d),s.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=s.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=s.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=s.HALF_FLOAT:f=s.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=s.SHORT;else if(c instanceof Uint32Array)f=s.UNSIGNED_INT;else if(c instanceof Int32Array)f=s.INT;else if(c instanceof Int8Array)f=s.BYTE;else if(c instanceof Uint8Array)f=s.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=s.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function i(a,l,c){let h=l.array,u=l.updateRanges;if(s.bindBuffer(c,a),u.length===0)s.bufferSubData(c,0,h);else{u.sort((f,m)=>f.start-m.start);let d=0;for(let f=1;f<u.length;f++){let m=u[d],x=u[f];x.start<=m.start+m.count+1?m.count=Math.max(m.count,x.start+x.count-m.start):(++d,u[d]=x)}u.length=d+1;for(let f=0,m=u.length;f<m;f++){let x=u[f];s.bufferSubData(c,x.start*h.BYTES_PER_ELEMENT,h,x.start,x.count)}l.clearUpdateRanges()}l.onUploadCallback()}function n(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=t.get(a);l&&(s.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(c.buffer,a,l),c.version=a.version}}return{get:n,remove:r,update:o}}var px=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,mx=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,gx=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,xx=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,yx=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,_x=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,vx=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,bx=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,Sx=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,wx=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,Mx=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,Tx=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,Ax=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,Ex=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,Rx=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,Cx=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,Px=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,Ix=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,Lx=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Nx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,Dx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,zx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,kx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Fx=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,Ox=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,Ux=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Bx=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,Vx=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,Hx=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,Gx="gl_FragColor = linearToOutputTexel( gl_FragColor );",Wx=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Xx=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,qx=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,jx=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,Yx=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,$x=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,Zx=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,Jx=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,Kx=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,Qx=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,ty=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,ey=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,iy=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,ny=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,sy=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,ry=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,oy=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,ay=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,ly=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,cy=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,hy=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,uy=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,dy=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,fy=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,py=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,my=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,gy=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,xy=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,yy=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,_y=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,vy=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,by=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,Sy=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,wy=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,My=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,Ty=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,Ay=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,Ey=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,Ry=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Cy=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,Py=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Iy=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,Ly=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,Ny=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Dy=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,zy=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,ky=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,Fy=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,Oy=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,Uy=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,By=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,Vy=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Hy=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,Gy=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Wy=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Xy=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,qy=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,jy=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Yy=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,$y=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,Zy=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,Jy=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,Ky=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,Qy=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,t_=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,e_=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,i_=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,n_=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,s_=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,r_=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,o_=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,a_=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,l_=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,c_=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,h_=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,u_=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,d_=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,f_=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,p_=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,m_=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,g_=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,x_=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,y_=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,__=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,v_=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,b_=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,S_=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,w_=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,M_=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,T_=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,A_=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,E_=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,R_=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,C_=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,P_=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,I_=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,L_=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,N_=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,D_=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,z_=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,k_=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,F_=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,O_=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,U_=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,B_=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,V_=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,H_=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,G_=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,W_=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,X_=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,q_=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,qt={alphahash_fragment:px,alphahash_pars_fragment:mx,alphamap_fragment:gx,alphamap_pars_fragment:xx,alphatest_fragment:yx,alphatest_pars_fragment:_x,aomap_fragment:vx,aomap_pars_fragment:bx,batching_pars_vertex:Sx,batching_vertex:wx,begin_vertex:Mx,beginnormal_vertex:Tx,bsdfs:Ax,iridescence_fragment:Ex,bumpmap_pars_fragment:Rx,clipping_planes_fragment:Cx,clipping_planes_pars_fragment:Px,clipping_planes_pars_vertex:Ix,clipping_planes_vertex:Lx,color_fragment:Nx,color_pars_fragment:Dx,color_pars_vertex:zx,color_vertex:kx,common:Fx,defaultnormal_vertex:Ox,displacementmap_pars_vertex:Ux,displacementmap_vertex:Bx,emissivemap_fragment:Vx,emissivemap_pars_fragment:Hx,colorspace_fragment:Gx,colorspace_pars_fragment:Wx,envmap_fragment:Xx,envmap_common_pars_fragment:qx,envmap_pars_fragment:jx,envmap_pars_vertex:Yx,envmap_physical_pars_fragment:ry,envmap_vertex:$x,fog_vertex:Zx,fog_pars_vertex:Jx,fog_fragment:Kx,fog_pars_fragment:Qx,gradientmap_pars_fragment:ty,lightmap_pars_fragment:ey,lights_lambert_fragment:iy,lights_lambert_pars_fragment:ny,lights_pars_begin:sy,lights_toon_fragment:oy,lights_toon_pars_fragment:ay,lights_phong_fragment:ly,lights_phong_pars_fragment:cy,lights_physical_fragment:hy,lights_physical_pars_fragment:uy,lights_fragment_begin:dy,lights_fragment_maps:fy,lights_fragment_end:py,lightprobes_pars_fragment:my,logdepthbuf_fragment:gy,logdepthbuf_pars_fragment:xy,logdepthbuf_pars_vertex:yy,logdepthbuf_vertex:_y,map_fragment:vy,map_pars_fragment:by,map_particle_fragment:Sy,map_particle_pars_fragment:wy,metalnessmap_fragment:My,metalnessmap_pars_fragment:Ty,morphinstance_vertex:Ay,morphcolor_vertex:Ey,morphnormal_vertex:Ry,morphtarget_pars_vertex:Cy,morphtarget_vertex:Py,normal_fragment_begin:Iy,normal_fragment_maps:Ly,normal_pars_fragment:Ny,normal_pars_vertex:Dy,normal_vertex:zy,normalmap_pars_fragment:ky,clearcoat_normal_fragment_begin:Fy,clearcoat_normal_fragment_maps:Oy,clearcoat_pars_fragment:Uy,iridescence_pars_fragment:By,opaque_fragment:Vy,packing:Hy,premultiplied_alpha_fragment:Gy,project_vertex:Wy,dithering_fragment:Xy,dithering_pars_fragment:qy,roughnessmap_fragment:jy,roughnessmap_pars_fragment:Yy,shadowmap_pars_fragment:$y,shadowmap_pars_vertex:Zy,shadowmap_vertex:Jy,shadowmask_pars_fragment:Ky,skinbase_vertex:Qy,skinning_pars_vertex:t_,skinning_vertex:e_,skinnormal_vertex:i_,specularmap_fragment:n_,specularmap_pars_fragment:s_,tonemapping_fragment:r_,tonemapping_pars_fragment:o_,transmission_fragment:a_,transmission_pars_fragment:l_,uv_pars_fragment:c_,uv_pars_vertex:h_,uv_vertex:u_,worldpos_vertex:d_,background_vert:f_,background_frag:p_,backgroundCube_vert:m_,backgroundCube_frag:g_,cube_vert:x_,cube_frag:y_,depth_vert:__,depth_frag:v_,distance_vert:b_,distance_frag:S_,equirect_vert:w_,equirect_frag:M_,linedashed_vert:T_,linedashed_frag:A_,meshbasic_vert:E_,meshbasic_frag:R_,meshlambert_vert:C_,meshlambert_frag:P_,meshmatcap_vert:I_,meshmatcap_frag:L_,meshnormal_vert:N_,meshnormal_frag:D_,meshphong_vert:z_,meshphong_frag:k_,meshphysical_vert:F_,meshphysical_frag:O_,meshtoon_vert:U_,meshtoon_frag:B_,points_vert:V_,points_frag:H_,shadow_vert:G_,shadow_frag:W_,sprite_vert:X_,sprite_frag:q_},bt={common:{diffuse:{value:new It(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Ot},alphaMap:{value:null},alphaMapTransform:{value:new Ot},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Ot}},envmap:{envMap:{value:null},envMapRotation:{value:new Ot},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Ot}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Ot}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Ot},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Ot},normalScale:{value:new Rt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Ot},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Ot}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Ot}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Ot}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new It(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new It(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Ot},alphaTest:{value:0},uvTransform:{value:new Ot}},sprite:{diffuse:{value:new It(16777215)},opacity:{value:1},center:{value:new Rt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Ot},alphaMap:{value:null},alphaMapTransform:{value:new Ot},alphaTest:{value:0}}},dn={basic:{uniforms:ri([bt.common,bt.specularmap,bt.envmap,bt.aomap,bt.lightmap,bt.fog]),vertexShader:qt.meshbasic_vert,fragmentShader:qt.meshbasic_frag},lambert:{uniforms:ri([bt.common,bt.specularmap,bt.envmap,bt.aomap,bt.lightmap,bt.emissivemap,bt.bumpmap,bt.normalmap,bt.displacementmap,bt.fog,bt.lights,{emissive:{value:new It(0)},envMapIntensity:{value:1}}]),vertexShader:qt.meshlambert_vert,fragmentShader:qt.meshlambert_frag},phong:{uniforms:ri([bt.common,bt.specularmap,bt.envmap,bt.aomap,bt.lightmap,bt.emissivemap,bt.bumpmap,bt.normalmap,bt.displacementmap,bt.fog,bt.lights,{emissive:{value:new It(0)},specular:{value:new It(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:qt.meshphong_vert,fragmentShader:qt.meshphong_frag},standard:{uniforms:ri([bt.common,bt.envmap,bt.aomap,bt.lightmap,bt.emissivemap,bt.bumpmap,bt.normalmap,bt.displacementmap,bt.roughnessmap,bt.metalnessmap,bt.fog,bt.lights,{emissive:{value:new It(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:qt.meshphysical_vert,fragmentShader:qt.meshphysical_frag},toon:{uniforms:ri([bt.common,bt.aomap,bt.lightmap,bt.emissivemap,bt.bumpmap,bt.normalmap,bt.displacementmap,bt.gradientmap,bt.fog,bt.lights,{emissive:{value:new It(0)}}]),vertexShader:qt.meshtoon_vert,fragmentShader:qt.meshtoon_frag},matcap:{uniforms:ri([bt.common,bt.bumpmap,bt.normalmap,bt.displacementmap,bt.fog,{matcap:{value:null}}]),vertexShader:qt.meshmatcap_vert,fragmentShader:qt.meshmatcap_frag},points:{uniforms:ri([bt.points,bt.fog]),vertexShader:qt.points_vert,fragmentShader:qt.points_frag},dashed:{uniforms:ri([bt.common,bt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:qt.linedashed_vert,fragmentShader:qt.linedashed_frag},depth:{uniforms:ri([bt.common,bt.displacementmap]),vertexShader:qt.depth_vert,fragmentShader:qt.depth_frag},normal:{uniforms:ri([bt.common,bt.bumpmap,bt.normalmap,bt.displacementmap,{opacity:{value:1}}]),vertexShader:qt.meshnormal_vert,fragmentShader:qt.meshnormal_frag},sprite:{uniforms:ri([bt.sprite,bt.fog]),vertexShader:qt.sprite_vert,fragmentShader:qt.sprite_frag},background:{uniforms:{uvTransform:{value:new Ot},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:qt.background_vert,fragmentShader:qt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Ot}},vertexShader:qt.backgroundCube_vert,fragmentShader:qt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:qt.cube_vert,fragmentShader:qt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:qt.equirect_vert,fragmentShader:qt.equirect_frag},distance:{uniforms:ri([bt.common,bt.displacementmap,{referencePosition:{value:new C},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:qt.distance_vert,fragmentShader:qt.distance_frag},shadow:{uniforms:ri([bt.lights,bt.fog,{color:{value:new It(0)},opacity:{value:1}}]),vertexShader:qt.shadow_vert,fragmentShader:qt.shadow_frag}};dn.physical={uniforms:ri([dn.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Ot},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Ot},clearcoatNormalScale:{value:new Rt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Ot},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Ot},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Ot},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Ot},sheen:{value:0},sheenColor:{value:new It(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Ot},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Ot},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Ot},transmissionSamplerSize:{value:new Rt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Ot},attenuationDistance:{value:0},attenuationColor:{value:new It(0)},specularColor:{value:new It(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Ot},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Ot},anisotropyVector:{value:new Rt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Ot}}]),vertexShader:qt.meshphysical_vert,fragmentShader:qt.meshphysical_frag};var ql={r:0,b:0,g:0},j_=new wt,kp=new Ot;kp.set(-1,0,0,0,1,0,0,0,1);function Y_(s,t,e,i,n,r){let o=new It(0),a=n===!0?0:1,l,c,h=null,u=0,d=null;function f(_){let b=_.isScene===!0?_.background:null;if(b&&b.isTexture){let y=_.backgroundBlurriness>0;b=t.get(b,y)}return b}function m(_){let b=!1,y=f(_);y===null?p(o,a):y&&y.isColor&&(p(y,1),b=!0);let M=s.xr.getEnvironmentBlendMode();M==="additive"?e.buffers.color.setClear(0,0,0,1,r):M==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(s.autoClear||b)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),s.clear(s.autoClearColor,s.autoClearDepth,s.autoClearStencil))}function x(_,b){let y=f(b);y&&y.isCubeTexture?(c===void 0&&(c=new st(new ye(1,1,1),new an({name:"BackgroundCubeMaterial",uniforms:Ds(dn.backgroundCube.uniforms),vertexShader:dn.backgroundCube.vertexShader,fragmentShader:dn.backgroundCube.fragmentShader,side:ui,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(M,S,v){this.matrixWorld.copyPosition(v.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(c)),c.material.uniforms.envMap.value=y,c.material.uniforms.backgroundBlurriness.value=b.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(j_.makeRotationFromEuler(b.backgroundRotation)).transpose(),y.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(kp),c.material.toneMapped=Ht.getTransfer(y.colorSpace)!==ne,(h!==y||u!==y.version||d!==s.toneMapping)&&(c.material.needsUpdate=!0,h=y,u=y.version,d=s.toneMapping),c.layers.enableAll(),_.unshift(c,c.geometry,c.material,0,0,null)):y&&y.isTexture&&(l===void 0&&(l=new st(new ws(2,2),new an({name:"BackgroundMaterial",uniforms:Ds(dn.background.uniforms),vertexShader:dn.background.vertexShader,fragmentShader:dn.background.fragmentShader,side:cn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(l)),l.material.uniforms.t2D.value=y,l.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,l.material.toneMapped=Ht.getTransfer(y.colorSpace)!==ne,y.matrixAutoUpdate===!0&&y.updateMatrix(),l.material.uniforms.uvTransform.value.copy(y.matrix),(h!==y||u!==y.version||d!==s.toneMapping)&&(l.material.needsUpdate=!0,h=y,u=y.version,d=s.toneMapping),l.layers.enableAll(),_.unshift(l,l.geometry,l.material,0,0,null))}function p(_,b){_.getRGB(ql,bu(s)),e.buffers.color.setClear(ql.r,ql.g,ql.b,b,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(_,b=1){o.set(_),a=b,p(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(_){a=_,p(o,a)},render:m,addToRenderList:x,dispose:g}}function $_(s,t){let e=s.getParameter(s.MAX_VERTEX_ATTRIBS),i={},n=d(null),r=n,o=!1;function a(L,D,U,N,V){let k=!1,B=u(L,N,U,D);r!==B&&(r=B,c(r.object)),k=f(L,N,U,V),k&&m(L,N,U,V),V!==null&&t.update(V,s.ELEMENT_ARRAY_BUFFER),(k||o)&&(o=!1,y(L,D,U,N),V!==null&&s.bindBuffer(s.ELEMENT_ARRAY_BUFFER,t.get(V).buffer))}function l(){return s.createVertexArray()}function c(L){return s.bindVertexArray(L)}function h(L){return s.deleteVertexArray(L)}function u(L,D,U,N){let V=N.wireframe===!0,k=i[D.id];k===void 0&&(k={},i[D.id]=k);let B=L.isInstancedMesh===!0?L.id:0,Y=k[B];Y===void 0&&(Y={},k[B]=Y);let H=Y[U.id];H===void 0&&(H={},Y[U.id]=H);let $=H[V];return $===void 0&&($=d(l()),H[V]=$),$}function d(L){let D=[],U=[],N=[];for(let V=0;V<e;V++)D[V]=0,U[V]=0,N[V]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:D,enabledAttributes:U,attributeDivisors:N,object:L,attributes:{},index:null}}function f(L,D,U,N){let V=r.attributes,k=D.attributes,B=0,Y=U.getAttributes();for(let H in Y)if(Y[H].location>=0){let Z=V[H],ct=k[H];if(ct===void 0&&(H==="instanceMatrix"&&L.instanceMatrix&&(ct=L.instanceMatrix),H==="instanceColor"&&L.instanceColor&&(ct=L.instanceColor)),Z===void 0||Z.attribute!==ct||ct&&Z.data!==ct.data)return!0;B++}return r.attributesNum!==B||r.index!==N}function m(L,D,U,N){let V={},k=D.attributes,B=0,Y=U.getAttributes();for(let H in Y)if(Y[H].location>=0){let Z=k[H];Z===void 0&&(H==="instanceMatrix"&&L.instanceMatrix&&(Z=L.instanceMatrix),H==="instanceColor"&&L.instanceColor&&(Z=L.instanceColor));let ct={};ct.attribute=Z,Z&&Z.data&&(ct.data=Z.data),V[H]=ct,B++}r.attributes=V,r.attributesNum=B,r.index=N}function x(){let L=r.newAttributes;for(let D=0,U=L.length;D<U;D++)L[D]=0}function p(L){g(L,0)}function g(L,D){let U=r.newAttributes,N=r.enabledAttributes,V=r.attributeDivisors;U[L]=1,N[L]===0&&(s.enableVertexAttribArray(L),N[L]=1),V[L]!==D&&(s.vertexAttribDivisor(L,D),V[L]=D)}function _(){let L=r.newAttributes,D=r.enabledAttributes;for(let U=0,N=D.length;U<N;U++)D[U]!==L[U]&&(s.disableVertexAttribArray(U),D[U]=0)}function b(L,D,U,N,V,k,B){B===!0?s.vertexAttribIPointer(L,D,U,V,k):s.vertexAttribPointer(L,D,U,N,V,k)}function y(L,D,U,N){x();let V=N.attributes,k=U.getAttributes(),B=D.defaultAttributeValues;for(let Y in k){let H=k[Y];if(H.location>=0){let $=V[Y];if($===void 0&&(Y==="instanceMatrix"&&L.instanceMatrix&&($=L.instanceMatrix),Y==="instanceColor"&&L.instanceColor&&($=L.instanceColor)),$!==void 0){let Z=$.normalized,ct=$.itemSize,ut=t.get($);if(ut===void 0)continue;let G=ut.buffer,Q=ut.type,et=ut.bytesPerElement,rt=Q===s.INT||Q===s.UNSIGNED_INT||$.gpuType===cl;if($.isInterleavedBufferAttribute){let at=$.data,Lt=at.isInterleavedBuffer===!0?at.stride:at.itemSize,le=$.offset;if(at.isInstancedInterleavedBuffer||at.isInstancedBufferAttribute){for(let Nt=0;Nt<H.locationSize;Nt++)g(H.location+Nt,at.meshPerAttribute);L.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=at.meshPerAttribute*at.count)}else for(let Nt=0;Nt<H.locationSize;Nt++)p(H.location+Nt);s.bindBuffer(s.ARRAY_BUFFER,G);for(let Nt=0;Nt<H.locationSize;Nt++)b(H.location+Nt,ct/H.locationSize,Q,Z,Lt*et,(le+ct/H.locationSize*Nt)*et,rt)}else{if($.isInstancedBufferAttribute){for(let at=0;at<H.locationSize;at++)g(H.location+at,$.meshPerAttribute);L.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=$.meshPerAttribute*$.count)}else for(let at=0;at<H.locationSize;at++)p(H.location+at);s.bindBuffer(s.ARRAY_BUFFER,G);for(let at=0;at<H.locationSize;at++)b(H.location+at,ct/H.locationSize,Q,Z,ct*et,ct/H.locationSize*at*et,rt)}}else if(B!==void 0){let Z=B[Y];if(Z!==void 0)switch(Z.length){case 2:s.vertexAttrib2fv(H.location,Z);break;case 3:s.vertexAttrib3fv(H.location,Z);break;case 4:s.vertexAttrib4fv(H.location,Z);break;default:s.vertexAttrib1fv(H.location,Z)}}}}_()}function M(){E();for(let L in i){let D=i[L];for(let U in D){let N=D[U];for(let V in N){let k=N[V];for(let B in k)h(k[B].object),delete k[B];delete N[V]}}delete i[L]}}function S(L){if(i[L.id]===void 0)return;let D=i[L.id];for(let U in D){let N=D[U];for(let V in N){let k=N[V];for(let B in k)h(k[B].object),delete k[B];delete N[V]}}delete i[L.id]}function v(L){for(let D in i){let U=i[D];for(let N in U){let V=U[N];if(V[L.id]===void 0)continue;let k=V[L.id];for(let B in k)h(k[B].object),delete k[B];delete V[L.id]}}}function w(L){for(let D in i){let U=i[D],N=L.isInstancedMesh===!0?L.id:0,V=U[N];if(V!==void 0){for(let k in V){let B=V[k];for(let Y in B)h(B[Y].object),delete B[Y];delete V[k]}delete U[N],Object.keys(U).length===0&&delete i[D]}}}function E(){R(),o=!0,r!==n&&(r=n,c(r.object))}function R(){n.geometry=null,n.program=null,n.wireframe=!1}return{setup:a,reset:E,resetDefaultState:R,dispose:M,releaseStatesOfGeometry:S,releaseStatesOfObject:w,releaseStatesOfProgram:v,initAttributes:x,enableAttribute:p,disableUnusedAttributes:_}}function Z_(s,t,e){let i;function n(l){i=l}function r(l,c){s.drawArrays(i,l,c),e.update(c,i,1)}function o(l,c,h){h!==0&&(s.drawArraysInstanced(i,l,c,h),e.update(c,i,h))}function a(l,c,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];e.update(d,i,1)}this.setMode=n,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function J_(s,t,e,i){let n;function r(){if(n!==void 0)return n;if(t.has("EXT_texture_filter_anisotropic")===!0){let v=t.get("EXT_texture_filter_anisotropic");n=s.getParameter(v.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else n=0;return n}function o(v){return!(v!==Oi&&i.convert(v)!==s.getParameter(s.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(v){let w=v===Ji&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(v!==yi&&v!==Fi&&!w&&i.convert(v)!==s.getParameter(s.IMPLEMENTATION_COLOR_READ_TYPE))}function l(v){if(v==="highp"){if(s.getShaderPrecisionFormat(s.VERTEX_SHADER,s.HIGH_FLOAT).precision>0&&s.getShaderPrecisionFormat(s.FRAGMENT_SHADER,s.HIGH_FLOAT).precision>0)return"highp";v="mediump"}return v==="mediump"&&s.getShaderPrecisionFormat(s.VERTEX_SHADER,s.MEDIUM_FLOAT).precision>0&&s.getShaderPrecisionFormat(s.FRAGMENT_SHADER,s.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",h=l(c);h!==c&&(Pt("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),d=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&Pt("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&Pt("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=s.getParameter(s.MAX_TEXTURE_IMAGE_UNITS),m=s.getParameter(s.MAX_VERTEX_TEXTURE_IMAGE_UNITS),x=s.getParameter(s.MAX_TEXTURE_SIZE),p=s.getParameter(s.MAX_CUBE_MAP_TEXTURE_SIZE),g=s.getParameter(s.MAX_VERTEX_ATTRIBS),_=s.getParameter(s.MAX_VERTEX_UNIFORM_VECTORS),b=s.getParameter(s.MAX_VARYING_VECTORS),y=s.getParameter(s.MAX_FRAGMENT_UNIFORM_VECTORS),M=s.getParameter(s.MAX_SAMPLES),S=s.getParameter(s.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:m,maxTextureSize:x,maxCubemapSize:p,maxAttributes:g,maxVertexUniforms:_,maxVaryings:b,maxFragmentUniforms:y,maxSamples:M,samples:S}}function K_(s){let t=this,e=null,i=0,n=!1,r=!1,o=new Ei,a=new Ot,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||i!==0||n;return n=d,i=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){e=h(u,d,0)},this.setState=function(u,d,f){let m=u.clippingPlanes,x=u.clipIntersection,p=u.clipShadows,g=s.get(u);if(!n||m===null||m.length===0||r&&!p)r?h(null):c();else{let _=r?0:i,b=_*4,y=g.clippingState||null;l.value=y,y=h(m,d,b,f);for(let M=0;M!==b;++M)y[M]=e[M];g.clippingState=y,this.numIntersection=x?this.numPlanes:0,this.numPlanes+=_}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=i>0),t.numPlanes=i,t.numIntersection=0}function h(u,d,f,m){let x=u!==null?u.length:0,p=null;if(x!==0){if(p=l.value,m!==!0||p===null){let g=f+x*4,_=d.matrixWorldInverse;a.getNormalMatrix(_),(p===null||p.length<g)&&(p=new Float32Array(g));for(let b=0,y=f;b!==x;++b,y+=4)o.copy(u[b]).applyMatrix4(_,a),o.normal.toArray(p,y),p[y+3]=o.constant}l.value=p,l.needsUpdate=!0}return t.numPlanes=x,t.numIntersection=0,p}}var ko=class extends Ri{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let i={width:t,height:t,depth:1},n=[i,i,i,i,i,i];this.texture=new lo(n),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},n=new ye(5,5,5),r=new an({name:"CubemapFromEquirect",uniforms:Ds(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:ui,blending:Ps});r.uniforms.tEquirect.value=e;let o=new st(n,r),a=e.minFilter;return e.minFilter===ki&&(e.minFilter=Ve),new br(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e=!0,i=!0,n=!0){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,i,n);t.setRenderTarget(r)}},pp=256,Q_=3,tv=20,Fp=256,Op=16,ev=3,iv=new C,nv=new It,Yl=class s{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new br(1,10,null),this._boxMesh=new st(new ye(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,i=.1,n=100,r={}){let{size:o=256,position:a=iv}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,m=l.autoClearStencil,x=t.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,x===null&&(t.background=l.getClearColor(nv));let p=new br(i,n,h);return p.position.copy(a),p.update(l,t),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=m,t.background=x,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,e)),this._applyPMREM(c),c}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=xp(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=gp(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(pp,_u(t))}_fromTexture(t,e){t.mapping===Ls||t.mapping===Tr?this._setSize(t.image.length===0?pp:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let i=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(i),i}_allocateTarget(){let t=this._cubeSize,e=mp(t,!1,!1),i=Math.log2(t)-Q_;for(let n=0;n<=i;n++)e.texture.mipmaps.push({width:t>>n,height:t>>n});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==e||t&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=mp(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,i){let n=this._boxMesh,r=this._cubeCamera;n.material=i,r.renderTarget=t,r.activeMipmapLevel=e;let o=t.width>>e;t.viewport.set(0,0,o,o),r.update(this._renderer,n),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===Ls||t.mapping===Tr?(this._cubemapMaterial===null&&(this._cubemapMaterial=xp()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=gp()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=sv(),this._integrationMaterial=rv());let e=this._cubeSize,i=t.texture.mipmaps.length-1,n=this._ggxMaterial.uniforms;n.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/Op);for(let o=0;o<=i;o++){let a=s.lodToRoughness(o,i);if(o>i-ev)r.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let l=a>0?Math.log2(e)+.5*Math.log2(6/(Fp*Math.pow(a,4)))+.5:0;n.roughness.value=a,n.lodBias.value=l,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=ov());let i=this._blurMaterial,n=i.uniforms,r=this._sourceTarget;n.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,n.envMap.value=r.texture,this._renderCube(t,0,i),n.envMap.value=t.texture,this._renderCube(r,0,i)}};function mp(s,t,e){return new ko(s,{minFilter:ki,generateMipmaps:t,type:Ji,colorSpace:to,depthBuffer:e})}function Fo(s,t,e){return new an({name:s,uniforms:t,vertexShader:qt.cube_vert,fragmentShader:e,side:ui,blending:Ps,depthTest:!1,depthWrite:!1})}function sv(){return Fo("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${Fp}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function rv(){return Fo("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Op}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function ov(){return Fo("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${tv}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function gp(){return Fo("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function xp(){return Fo("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function av(s){let t=new WeakMap,e=new WeakMap,i=null;function n(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===ol||f===al)if(t.has(d)){let m=t.get(d).texture;return a(m,d.mapping)}else{let m=d.image;if(m&&m.height>0){let x=new ko(m.height);return x.fromEquirectangularTexture(s,d),t.set(d,x),d.addEventListener("dispose",c),a(x.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,m=f===ol||f===al,x=f===Ls||f===Tr;if(m||x){let p=e.get(d),g=p!==void 0?p.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==g)return i===null&&(i=new Yl(s)),p=m?i.fromEquirectangular(d,p):i.fromCubemap(d,p),p.texture.pmremVersion=d.pmremVersion,e.set(d,p),p.texture;if(p!==void 0)return p.texture;{let _=d.image;return m&&_&&_.height>0||x&&_&&l(_)?(i===null&&(i=new Yl(s)),p=m?i.fromEquirectangular(d):i.fromCubemap(d),p.texture.pmremVersion=d.pmremVersion,e.set(d,p),d.addEventListener("dispose",h),p.texture):null}}}return d}function a(d,f){return f===ol?d.mapping=Ls:f===al&&(d.mapping=Tr),d}function l(d){let f=0,m=6;for(let x=0;x<m;x++)d[x]!==void 0&&f++;return f===m}function c(d){let f=d.target;f.removeEventListener("dispose",c);let m=t.get(f);m!==void 0&&(t.delete(f),m.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let m=e.get(f);m!==void 0&&(e.delete(f),m.dispose())}function u(){t=new WeakMap,e=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:n,dispose:u}}function lv(s){let t={};function e(i){if(t[i]!==void 0)return t[i];let n=s.getExtension(i);return t[i]=n,n}return{has:function(i){return e(i)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(i){let n=e(i);return n===null&&Zr("WebGLRenderer: "+i+" extension not supported."),n}}}function cv(s,t,e,i){let n={},r=new WeakMap,o=new FinalizationRegistry(m=>delete n[m]);function a(m){l(m.target)}function l(m){m.index!==null&&t.remove(m.index);for(let p in m.attributes)t.remove(m.attributes[p]);m.removeEventListener("dispose",a),delete n[m.id],o.unregister(m);let x=r.get(m);x&&(t.remove(x),r.delete(m)),i.releaseStatesOfGeometry(m),m.isInstancedBufferGeometry===!0&&delete m._maxInstanceCount,e.memory.geometries--}function c(m,x){return n[x.id]!==void 0||(x.addEventListener("dispose",a),n[x.id]=new WeakRef(x),o.register(x,x.id,x),e.memory.geometries++),x}function h(m){let x=m.attributes;for(let p in x)t.update(x[p],s.ARRAY_BUFFER)}function u(m){let x=m.index,p=m.attributes.position,g=0;if(p===void 0)return;let _=x!==null?x.array.length:p.array.length/3-1,b=p.count>=65535?so:no,y=new b(Math.ceil(_/3)*6,1),M=y.array;if(x!==null){let v=x.array;g=x.version;for(let w=0,E=0;w<_;w+=3){let R=v[w+0],L=v[w+1],D=v[w+2];M[E++]=R,M[E++]=L,M[E++]=L,M[E++]=D,M[E++]=D,M[E++]=R}}else{g=p.version;for(let v=0,w=0;v<_;v+=3){let E=v+0,R=v+1,L=v+2;M[w++]=E,M[w++]=R,M[w++]=R,M[w++]=L,M[w++]=L,M[w++]=E}}y.version=g;let S=r.get(m);S&&t.remove(S),r.set(m,y)}function d(m){let x=r.get(m);if(x){let p=m.index;p!==null&&x.version<p.version&&u(m)}else u(m);return r.get(m)}function f(){for(let m in n){let x=n[m].deref();x!==void 0&&l(x)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function hv(s,t,e){let i;function n(u){i=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){s.drawElements(i,d,r,u*o),e.update(d,i,1)}function c(u,d,f){f!==0&&(s.drawElementsInstanced(i,d,r,u*o,f),e.update(d,i,f))}function h(u,d,f){if(f===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,d,0,r,u,0,f);let x=0;for(let p=0;p<f;p++)x+=d[p];e.update(x,i,1)}this.setMode=n,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function uv(s){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,o,a){switch(e.calls++,o){case s.TRIANGLES:e.triangles+=a*(r/3);break;case s.LINES:e.lines+=a*(r/2);break;case s.LINE_STRIP:e.lines+=a*(r-1);break;case s.LINE_LOOP:e.lines+=a*r;break;case s.POINTS:e.points+=a*r;break;default:kt("WebGLInfo: Unknown draw mode:",o);break}}function n(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:n,update:i}}function dv(s,t,e){let i=new WeakMap,n=new ae;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=i.get(a);if(d===void 0||d.count!==u){let E=function(){v.dispose(),i.delete(a),a.removeEventListener("dispose",E)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,m=a.morphAttributes.normal!==void 0,x=a.morphAttributes.color!==void 0,p=a.morphAttributes.position||[],g=a.morphAttributes.normal||[],_=a.morphAttributes.color||[],b=0;f===!0&&(b=1),m===!0&&(b=2),x===!0&&(b=3);let y=a.attributes.position.count*b,M=1;y>t.maxTextureSize&&(M=Math.ceil(y/t.maxTextureSize),y=t.maxTextureSize);let S=new Float32Array(y*M*4*u),v=new io(S,y,M,u);v.type=Fi,v.needsUpdate=!0;let w=b*4;for(let R=0;R<u;R++){let L=p[R],D=g[R],U=_[R],N=y*M*4*R;for(let V=0;V<L.count;V++){let k=V*w;f===!0&&(n.fromBufferAttribute(L,V),S[N+k+0]=n.x,S[N+k+1]=n.y,S[N+k+2]=n.z,S[N+k+3]=0),m===!0&&(n.fromBufferAttribute(D,V),S[N+k+4]=n.x,S[N+k+5]=n.y,S[N+k+6]=n.z,S[N+k+7]=0),x===!0&&(n.fromBufferAttribute(U,V),S[N+k+8]=n.x,S[N+k+9]=n.y,S[N+k+10]=n.z,S[N+k+11]=U.itemSize===4?n.w:1)}}d={count:u,texture:v,size:new Rt(y,M)},i.set(a,d),a.addEventListener("dispose",E)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(s,"morphTexture",o.morphTexture,e);else{let f=0;for(let x=0;x<c.length;x++)f+=c[x];let m=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(s,"morphTargetBaseInfluence",m),l.getUniforms().setValue(s,"morphTargetInfluences",c)}l.getUniforms().setValue(s,"morphTargetsTexture",d.texture,e),l.getUniforms().setValue(s,"morphTargetsTextureSize",d.size)}return{update:r}}function fv(s,t,e,i,n){let r=new WeakMap;function o(c){let h=n.render.frame,u=c.geometry,d=t.get(c,u);if(r.get(d)!==h&&(t.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(e.update(c.instanceMatrix,s.ARRAY_BUFFER),c.instanceColor!==null&&e.update(c.instanceColor,s.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),i.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:o,dispose:a}}var pv={[Kh]:"LINEAR_TONE_MAPPING",[Qh]:"REINHARD_TONE_MAPPING",[tu]:"CINEON_TONE_MAPPING",[eu]:"ACES_FILMIC_TONE_MAPPING",[nu]:"AGX_TONE_MAPPING",[su]:"NEUTRAL_TONE_MAPPING",[iu]:"CUSTOM_TONE_MAPPING"};function mv(s,t,e,i,n,r){let o=new Ri(t,e,{type:s,depthBuffer:n,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new ce;h.setAttribute("position",new Ft([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new Ft([0,2,0,0,2,0],2));let u=new Za({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),d=new st(h,u),f=new As(-1,1,1,-1,0,1),m=null,x=null,p=!1,g,_=null,b=[],y=!1;this.setSize=function(M,S){o.setSize(M,S),a!==null&&a.setSize(M,S),l!==null&&l.setSize(M,S);for(let v=0;v<b.length;v++){let w=b[v];w.setSize&&w.setSize(M,S)}},this.setEffects=function(M){b=M,y=b.length>0&&b[0].isRenderPass===!0;let S=o.width,v=o.height;b.length>0&&a===null&&(a=new Ri(S,v,{type:Ji,depthBuffer:!1,stencilBuffer:!1}),l=new Ri(S,v,{type:Ji,depthBuffer:!1,stencilBuffer:!1}));let w=n===!0&&b.some(E=>E.needsDepthTexture===!0);w!==(o.depthTexture!==null)&&(w===!0&&c===null&&(c=new Rn(S,v),r===!0&&(c.format=Ln,c.type=Ns)),o.dispose(),o.depthTexture=w?c:null,o.resolveDepthBuffer=w,o.storeMultisampledDepthBuffer=w);for(let E=0;E<b.length;E++){let R=b[E];R.setSize&&R.setSize(S,v),w&&R.needsDepthTexture===!0&&R.setDepthTexture&&R.setDepthTexture(c)}},this.begin=function(M,S){if(p||M.toneMapping===hn&&b.length===0)return!1;if(_=S,S!==null){let v=S.width,w=S.height;(o.width!==v||o.height!==w)&&this.setSize(v,w)}return y===!1&&M.setRenderTarget(o),g=M.toneMapping,M.toneMapping=hn,!0},this.hasRenderPass=function(){return y},this.end=function(M,S){M.toneMapping=g,p=!0;let v=o,w=a;for(let E=0;E<b.length;E++){let R=b[E];R.enabled!==!1&&(R.render(M,w,v,S),R.needsSwap!==!1&&(v=w,w=w===a?l:a))}if(m!==M.outputColorSpace||x!==M.toneMapping){m=M.outputColorSpace,x=M.toneMapping,u.defines={},Ht.getTransfer(m)===ne&&(u.defines.SRGB_TRANSFER="");let E=pv[x];E&&(u.defines[E]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=v.texture,M.setRenderTarget(_),M.render(d,f),_=null,p=!1},this.isCompositing=function(){return p},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var Up=new hi,Bp=new Rn(1,1),Vp=new co(1),Hp=new io,Gp=new Xa,Wp=new lo,yp=[],_p=[],vp=new Float32Array(16),bp=new Float32Array(9),Sp=new Float32Array(4);function Rr(s,t,e){let i=s[0];if(i<=0||i>0)return s;let n=t*e,r=yp[n];if(r===void 0&&(r=new Float32Array(n),yp[n]=r),t!==0){i.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,s[o].toArray(r,a)}return r}function Ne(s,t){if(s.length!==t.length)return!1;for(let e=0,i=s.length;e<i;e++)if(s[e]!==t[e])return!1;return!0}function De(s,t){for(let e=0,i=t.length;e<i;e++)s[e]=t[e]}function Zl(s,t){let e=_p[t];e===void 0&&(e=new Int32Array(t),_p[t]=e);for(let i=0;i!==t;++i)e[i]=s.allocateTextureUnit();return e}function gv(s,t){let e=this.cache;e[0]!==t&&(s.uniform1f(this.addr,t),e[0]=t)}function xv(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(s.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Ne(e,t))return;s.uniform2fv(this.addr,t),De(e,t)}}function yv(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(s.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(s.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(Ne(e,t))return;s.uniform3fv(this.addr,t),De(e,t)}}function _v(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(s.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Ne(e,t))return;s.uniform4fv(this.addr,t),De(e,t)}}function vv(s,t){let e=this.cache,i=t.elements;if(i===void 0){if(Ne(e,t))return;s.uniformMatrix2fv(this.addr,!1,t),De(e,t)}else{if(Ne(e,i))return;Sp.set(i),s.uniformMatrix2fv(this.addr,!1,Sp),De(e,i)}}function bv(s,t){let e=this.cache,i=t.elements;if(i===void 0){if(Ne(e,t))return;s.uniformMatrix3fv(this.addr,!1,t),De(e,t)}else{if(Ne(e,i))return;bp.set(i),s.uniformMatrix3fv(this.addr,!1,bp),De(e,i)}}function Sv(s,t){let e=this.cache,i=t.elements;if(i===void 0){if(Ne(e,t))return;s.uniformMatrix4fv(this.addr,!1,t),De(e,t)}else{if(Ne(e,i))return;vp.set(i),s.uniformMatrix4fv(this.addr,!1,vp),De(e,i)}}function wv(s,t){let e=this.cache;e[0]!==t&&(s.uniform1i(this.addr,t),e[0]=t)}function Mv(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(s.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Ne(e,t))return;s.uniform2iv(this.addr,t),De(e,t)}}function Tv(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(s.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Ne(e,t))return;s.uniform3iv(this.addr,t),De(e,t)}}function Av(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(s.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Ne(e,t))return;s.uniform4iv(this.addr,t),De(e,t)}}function Ev(s,t){let e=this.cache;e[0]!==t&&(s.uniform1ui(this.addr,t),e[0]=t)}function Rv(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(s.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Ne(e,t))return;s.uniform2uiv(this.addr,t),De(e,t)}}function Cv(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(s.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Ne(e,t))return;s.uniform3uiv(this.addr,t),De(e,t)}}function Pv(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(s.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Ne(e,t))return;s.uniform4uiv(this.addr,t),De(e,t)}}function Jl(s){return s.version===0&&(s.compareFunction=mu,s.needsUpdate=!0),s}function Iv(s,t,e){let i=this.cache,n=e.allocateTextureUnit();i[0]!==n&&(s.uniform1i(this.addr,n),i[0]=n);let r;this.type===s.SAMPLER_2D_SHADOW?r=Jl(Bp):r=Up,e.setTexture2D(t||r,n)}function Lv(s,t,e){let i=this.cache,n=e.allocateTextureUnit();i[0]!==n&&(s.uniform1i(this.addr,n),i[0]=n),e.setTexture3D(t||Gp,n)}function Nv(s,t,e){let i=this.cache,n=e.allocateTextureUnit();i[0]!==n&&(s.uniform1i(this.addr,n),i[0]=n);let r;this.type===s.SAMPLER_CUBE_SHADOW?r=Jl(Vp):r=Wp,e.setTextureCube(t||r,n)}function Dv(s,t,e){let i=this.cache,n=e.allocateTextureUnit();i[0]!==n&&(s.uniform1i(this.addr,n),i[0]=n),e.setTexture2DArray(t||Hp,n)}function zv(s){switch(s){case 5126:return gv;case 35664:return xv;case 35665:return yv;case 35666:return _v;case 35674:return vv;case 35675:return bv;case 35676:return Sv;case 5124:case 35670:return wv;case 35667:case 35671:return Mv;case 35668:case 35672:return Tv;case 35669:case 35673:return Av;case 5125:return Ev;case 36294:return Rv;case 36295:return Cv;case 36296:return Pv;case 35678:case 36198:case 36298:case 36306:case 35682:return Iv;case 35679:case 36299:case 36307:return Lv;case 35680:case 36300:case 36308:case 36293:return Nv;case 36289:case 36303:case 36311:case 36292:return Dv}}function kv(s,t){s.uniform1fv(this.addr,t)}function Fv(s,t){let e=Rr(t,this.size,2);s.uniform2fv(this.addr,e)}function Ov(s,t){let e=Rr(t,this.size,3);s.uniform3fv(this.addr,e)}function Uv(s,t){let e=Rr(t,this.size,4);s.uniform4fv(this.addr,e)}function Bv(s,t){let e=Rr(t,this.size,4);s.uniformMatrix2fv(this.addr,!1,e)}function Vv(s,t){let e=Rr(t,this.size,9);s.uniformMatrix3fv(this.addr,!1,e)}function Hv(s,t){let e=Rr(t,this.size,16);s.uniformMatrix4fv(this.addr,!1,e)}function Gv(s,t){s.uniform1iv(this.addr,t)}function Wv(s,t){s.uniform2iv(this.addr,t)}function Xv(s,t){s.uniform3iv(this.addr,t)}function qv(s,t){s.uniform4iv(this.addr,t)}function jv(s,t){s.uniform1uiv(this.addr,t)}function Yv(s,t){s.uniform2uiv(this.addr,t)}function $v(s,t){s.uniform3uiv(this.addr,t)}function Zv(s,t){s.uniform4uiv(this.addr,t)}function Jv(s,t,e){let i=this.cache,n=t.length,r=Zl(e,n);Ne(i,r)||(s.uniform1iv(this.addr,r),De(i,r));let o;this.type===s.SAMPLER_2D_SHADOW?o=Jl(Bp):o=Up;for(let a=0;a!==n;++a)e.setTexture2D(t[a]||o,r[a])}function Kv(s,t,e){let i=this.cache,n=t.length,r=Zl(e,n);Ne(i,r)||(s.uniform1iv(this.addr,r),De(i,r));for(let o=0;o!==n;++o)e.setTexture3D(t[o]||Gp,r[o])}function Qv(s,t,e){let i=this.cache,n=t.length,r=Zl(e,n);Ne(i,r)||(s.uniform1iv(this.addr,r),De(i,r));let o;this.type===s.SAMPLER_CUBE_SHADOW?o=Jl(Vp):o=Wp;for(let a=0;a!==n;++a)e.setTextureCube(t[a]||o,r[a])}function tb(s,t,e){let i=this.cache,n=t.length,r=Zl(e,n);Ne(i,r)||(s.uniform1iv(this.addr,r),De(i,r));for(let o=0;o!==n;++o)e.setTexture2DArray(t[o]||Hp,r[o])}function eb(s){switch(s){case 5126:return kv;case 35664:return Fv;case 35665:return Ov;case 35666:return Uv;case 35674:return Bv;case 35675:return Vv;case 35676:return Hv;case 5124:case 35670:return Gv;case 35667:case 35671:return Wv;case 35668:case 35672:return Xv;case 35669:case 35673:return qv;case 5125:return jv;case 36294:return Yv;case 36295:return $v;case 36296:return Zv;case 35678:case 36198:case 36298:case 36306:case 35682:return Jv;case 35679:case 36299:case 36307:return Kv;case 35680:case 36300:case 36308:case 36293:return Qv;case 36289:case 36303:case 36311:case 36292:return tb}}var Eu=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.setValue=zv(e.type)}},Ru=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=eb(e.type)}},Cu=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,i){let n=this.seq;for(let r=0,o=n.length;r!==o;++r){let a=n[r];a.setValue(t,e[a.id],i)}}},Tu=/(\w+)(\])?(\[|\.)?/g;function wp(s,t){s.seq.push(t),s.map[t.id]=t}function ib(s,t,e){let i=s.name,n=i.length;for(Tu.lastIndex=0;;){let r=Tu.exec(i),o=Tu.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===n){wp(e,c===void 0?new Eu(a,s,t):new Ru(a,s,t));break}else{let u=e.map[a];u===void 0&&(u=new Cu(a),wp(e,u)),e=u}}}var Er=class{constructor(t,e){this.seq=[],this.map={};let i=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=t.getActiveUniform(e,o),l=t.getUniformLocation(e,a.name);ib(a,l,this)}let n=[],r=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?n.push(o):r.push(o);n.length>0&&(this.seq=n.concat(r))}setValue(t,e,i,n){let r=this.map[e];r!==void 0&&r.setValue(t,i,n)}setOptional(t,e,i){let n=e[i];n!==void 0&&this.setValue(t,i,n)}static upload(t,e,i,n){for(let r=0,o=e.length;r!==o;++r){let a=e[r],l=i[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,n)}}static seqWithValue(t,e){let i=[];for(let n=0,r=t.length;n!==r;++n){let o=t[n];o.id in e&&i.push(o)}return i}};function Mp(s,t,e){let i=s.createShader(t);return s.shaderSource(i,e),s.compileShader(i),i}var nb=37297,sb=0;function rb(s,t){let e=s.split(`
`),i=[],n=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=n;o<r;o++){let a=o+1;i.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return i.join(`
`)}var Tp=new Ot;function ob(s){Ht._getMatrix(Tp,Ht.workingColorSpace,s);let t=`mat3( ${Tp.elements.map(e=>e.toFixed(4))} )`;switch(Ht.getTransfer(s)){case eo:return[t,"LinearTransferOETF"];case ne:return[t,"sRGBTransferOETF"];default:return Pt("WebGLProgram: Unsupported color space: ",s),[t,"LinearTransferOETF"]}}function Ap(s,t,e){let i=s.getShaderParameter(t,s.COMPILE_STATUS),r=(s.getShaderInfoLog(t)||"").trim();if(i&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return e.toUpperCase()+`

`+r+`

`+rb(s.getShaderSource(t),a)}else return r}function ab(s,t){let e=ob(t);return[`vec4 ${s}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var lb={[Kh]:"Linear",[Qh]:"Reinhard",[tu]:"Cineon",[eu]:"ACESFilmic",[nu]:"AgX",[su]:"Neutral",[iu]:"Custom"};function cb(s,t){let e=lb[t];return e===void 0?(Pt("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+s+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+s+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var jl=new C;function hb(){Ht.getLuminanceCoefficients(jl);let s=jl.x.toFixed(4),t=jl.y.toFixed(4),e=jl.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${s}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function ub(s){return[s.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",s.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(zo).join(`
`)}function db(s){let t=[];for(let e in s){let i=s[e];i!==!1&&t.push("#define "+e+" "+i)}return t.join(`
`)}function fb(s,t){let e={},i=s.getProgramParameter(t,s.ACTIVE_ATTRIBUTES);for(let n=0;n<i;n++){let r=s.getActiveAttrib(t,n),o=r.name,a=1;r.type===s.FLOAT_MAT2&&(a=2),r.type===s.FLOAT_MAT3&&(a=3),r.type===s.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:s.getAttribLocation(t,o),locationSize:a}}return e}function zo(s){return s!==""}function Ep(s,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return s.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function Rp(s,t){return s.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var pb=/^[ \t]*#include +<([\w\d./]+)>/gm;function Pu(s){return s.replace(pb,mb)}function mb(s,t){let e=qt[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return Pu(e)}var gb=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function Cp(s){return s.replace(gb,xb)}function xb(s,t,e,i){let n="";for(let r=parseInt(t);r<parseInt(e);r++)n+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return n}function Pp(s){let t=`precision ${s.precision} float;
	precision ${s.precision} int;
	precision ${s.precision} sampler2D;
	precision ${s.precision} samplerCube;
	precision ${s.precision} sampler3D;
	precision ${s.precision} sampler2DArray;
	precision ${s.precision} sampler2DShadow;
	precision ${s.precision} samplerCubeShadow;
	precision ${s.precision} sampler2DArrayShadow;
	precision ${s.precision} isampler2D;
	precision ${s.precision} isampler3D;
	precision ${s.precision} isamplerCube;
	precision ${s.precision} isampler2DArray;
	precision ${s.precision} usampler2D;
	precision ${s.precision} usampler3D;
	precision ${s.precision} usamplerCube;
	precision ${s.precision} usampler2DArray;
	`;return s.precision==="highp"?t+=`
#define HIGH_PRECISION`:s.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:s.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var yb={[Mo]:"SHADOWMAP_TYPE_PCF",[wr]:"SHADOWMAP_TYPE_VSM"};function _b(s){return yb[s.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var vb={[Tr]:"ENVMAP_MODE_REFRACTION"};function bb(s){return s.envMap===!1?"ENVMAP_MODE_REFLECTION":vb[s.envMapMode]||"ENVMAP_MODE_REFLECTION"}var Sb={[To]:"ENVMAP_BLENDING_MULTIPLY",[Vf]:"ENVMAP_BLENDING_MIX",[Hf]:"ENVMAP_BLENDING_ADD"};function wb(s){return s.envMap===!1?"ENVMAP_BLENDING_NONE":Sb[s.combine]||"ENVMAP_BLENDING_NONE"}function Mb(s,t,e,i){let n=s.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,l=_b(e),c=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=bb(e),u=wb(e),d=ub(e),f=db(r),m=n.createProgram(),x,p,g=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(x=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(zo).join(`
`),x.length>0&&(x+=`
`),p=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(zo).join(`
`),p.length>0&&(p+=`
`)):(x=[Pp(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(zo).join(`
`),p=[Pp(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==hn?"#define TONE_MAPPING":"",e.toneMapping!==hn?qt.tonemapping_pars_fragment:"",e.toneMapping!==hn?cb("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",qt.colorspace_pars_fragment,ab("linearToOutputTexel",e.outputColorSpace),hb(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(zo).join(`
`)),o=Pu(o),o=Ep(o,e),o=Rp(o,e),a=Pu(a),a=Ep(a,e),a=Rp(a,e),o=Cp(o),a=Cp(a),e.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,x=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+x,p=["#define varying in",e.glslVersion===gu?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===gu?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+p);let _=g+x+o,b=g+p+a,y=Mp(n,n.VERTEX_SHADER,_),M=Mp(n,n.FRAGMENT_SHADER,b);n.attachShader(m,y),n.attachShader(m,M),e.index0AttributeName!==void 0?n.bindAttribLocation(m,0,e.index0AttributeName):e.hasPositionAttribute===!0&&n.bindAttribLocation(m,0,"position"),n.linkProgram(m);function S(R){if(s.debug.checkShaderErrors){let L=n.getProgramInfoLog(m)||"",D=n.getShaderInfoLog(y)||"",U=n.getShaderInfoLog(M)||"",N=L.trim(),V=D.trim(),k=U.trim(),B=!0,Y=!0;if(n.getProgramParameter(m,n.LINK_STATUS)===!1)if(B=!1,typeof s.debug.onShaderError=="function")s.debug.onShaderError(n,m,y,M);else{let H=Ap(n,y,"vertex"),$=Ap(n,M,"fragment");kt("WebGLProgram: Shader Error "+n.getError()+" - VALIDATE_STATUS "+n.getProgramParameter(m,n.VALIDATE_STATUS)+`

Material Name: `+R.name+`
Material Type: `+R.type+`

Program Info Log: `+N+`
`+H+`
`+$)}else N!==""?Pt("WebGLProgram: Program Info Log:",N):(V===""||k==="")&&(Y=!1);Y&&(R.diagnostics={runnable:B,programLog:N,vertexShader:{log:V,prefix:x},fragmentShader:{log:k,prefix:p}})}n.deleteShader(y),n.deleteShader(M),v=new Er(n,m),w=fb(n,m)}let v;this.getUniforms=function(){return v===void 0&&S(this),v};let w;this.getAttributes=function(){return w===void 0&&S(this),w};let E=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return E===!1&&(E=n.getProgramParameter(m,nb)),E},this.destroy=function(){i.releaseStatesOfProgram(this),n.deleteProgram(m),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=sb++,this.cacheKey=t,this.usedTimes=1,this.program=m,this.vertexShader=y,this.fragmentShader=M,this}var Tb=0,Iu=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,i){let n=this._getShaderCacheForMaterial(t);return n.has(e)===!1&&(n.add(e),e.usedTimes++),n.has(i)===!1&&(n.add(i),i.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let i of e)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,i=e.get(t);return i===void 0&&(i=new Set,e.set(t,i)),i}_getShaderStage(t){let e=this.shaderCache,i=e.get(t);return i===void 0&&(i=new Lu(t),e.set(t,i)),i}},Lu=class{constructor(t){this.id=Tb++,this.code=t,this.usedTimes=0}};function Ab(s){return s===Kn||s===Io||s===Lo}function Eb(s,t,e,i,n,r){let o=new fr,a=new Iu,l=new Set,c=[],h=new Map,u=i.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(v){return l.add(v),v===0?"uv":`uv${v}`}function m(v,w,E,R,L,D){let U=R.fog,N=L.geometry,V=v.isMeshStandardMaterial||v.isMeshLambertMaterial||v.isMeshPhongMaterial?R.environment:null,k=v.isMeshStandardMaterial||v.isMeshLambertMaterial&&!v.envMap||v.isMeshPhongMaterial&&!v.envMap,B=t.get(v.envMap||V,k),Y=d[v.type],H=i.precision;v.precision!==null&&(H=i.getMaxPrecision(v.precision),H!==v.precision&&Pt("WebGLProgram.getParameters:",v.precision,"not supported, using",H,"instead."));let $=N.morphAttributes.position||N.morphAttributes.normal||N.morphAttributes.color,Z=$!==void 0?$.length:0,ct=0;N.morphAttributes.position!==void 0&&(ct=1),N.morphAttributes.normal!==void 0&&(ct=2),N.morphAttributes.color!==void 0&&(ct=3);let ut,G,Q,et;if(Y){let vt=dn[Y];ut=vt.vertexShader,G=vt.fragmentShader}else{ut=v.vertexShader,G=v.fragmentShader;let vt=a.getVertexShaderStage(v),re=a.getFragmentShaderStage(v);a.update(v,vt,re),Q=vt.id,et=re.id}let rt=s.getRenderTarget(),at=s.state.buffers.depth.getReversed(),Lt=L.isInstancedMesh===!0,le=L.isBatchedMesh===!0,Nt=!!v.map,se=!!v.matcap,he=!!B,Yt=he&&B.isPMREMTexture===!0,qe=!!v.aoMap,Ie=!!v.lightMap,fi=!!v.bumpMap&&v.wireframe===!1,be=!!v.normalMap,en=!!v.displacementMap,Fe=!!v.emissiveMap,Ci=!!v.metalnessMap,Pi=!!v.roughnessMap,Ii=v.anisotropy>0,O=v.clearcoat>0,Li=v.diffuseRoughness>0,ge=v.dispersion>0,xe=v.retroreflectivity>0,_t=v.iridescence>0,Le=v.sheen>0,zt=v.transmission>0,Ut=Ii&&!!v.anisotropyMap,I=O&&!!v.clearcoatMap,T=O&&!!v.clearcoatNormalMap,X=O&&!!v.clearcoatRoughnessMap,ot=Li&&!!v.diffuseRoughnessMap,nt=_t&&!!v.iridescenceMap,dt=_t&&!!v.iridescenceThicknessMap,xt=Le&&!!v.sheenColorMap,K=Le&&!!v.sheenRoughnessMap,tt=!!v.specularMap,pt=!!v.specularColorMap,z=!!v.specularIntensityMap,it=zt&&!!v.transmissionMap,J=zt&&!!v.thicknessMap,mt=!!v.gradientMap,ht=!!v.alphaMap,ft=v.alphaTest>0,Ct=!!v.alphaHash,Xt=!!v.extensions,lt=hn;v.toneMapped&&(rt===null||rt.isXRRenderTarget===!0)&&(lt=s.toneMapping);let Dt=Yt?B.isCompressedCubeTexture?B.image[0].mipmaps:B.mipmaps:null,Gt={shaderID:Y,shaderType:v.type,shaderName:v.name,vertexShader:ut,fragmentShader:G,defines:v.defines,customVertexShaderID:Q,customFragmentShaderID:et,isRawShaderMaterial:v.isRawShaderMaterial===!0,glslVersion:v.glslVersion,precision:H,batching:le,batchingColor:le&&L._colorsTexture!==null,instancing:Lt,instancingColor:Lt&&L.instanceColor!==null,instancingMorph:Lt&&L.morphTexture!==null,outputColorSpace:rt===null?s.outputColorSpace:rt.isXRRenderTarget===!0?rt.texture.colorSpace:Ht.workingColorSpace,alphaToCoverage:!!v.alphaToCoverage,map:Nt,matcap:se,envMap:he,envMapMode:he&&B.mapping,envMapPMREM:Yt,envMapMaxLod:Yt?Dt.length-1:null,envMapSize:Yt?Dt[0].width:null,aoMap:qe,lightMap:Ie,bumpMap:fi,normalMap:be,displacementMap:en,emissiveMap:Fe,normalMapObjectSpace:be&&v.normalMapType===jf,normalMapTangentSpace:be&&v.normalMapType===No,packedNormalMap:be&&v.normalMapType===No&&Ab(v.normalMap.format),metalnessMap:Ci,roughnessMap:Pi,anisotropy:Ii,anisotropyMap:Ut,clearcoat:O,clearcoatMap:I,clearcoatNormalMap:T,clearcoatRoughnessMap:X,diffuseRoughness:Li,diffuseRoughnessMap:ot,dispersion:ge,retroreflection:xe,iridescence:_t,iridescenceMap:nt,iridescenceThicknessMap:dt,sheen:Le,sheenColorMap:xt,sheenRoughnessMap:K,specularMap:tt,specularColorMap:pt,specularIntensityMap:z,transmission:zt,transmissionMap:it,thicknessMap:J,gradientMap:mt,opaque:v.transparent===!1&&v.blending===Mr&&v.alphaToCoverage===!1,alphaMap:ht,alphaTest:ft,alphaHash:Ct,combine:v.combine,mapUv:Nt&&f(v.map.channel),aoMapUv:qe&&f(v.aoMap.channel),lightMapUv:Ie&&f(v.lightMap.channel),bumpMapUv:fi&&f(v.bumpMap.channel),normalMapUv:be&&f(v.normalMap.channel),displacementMapUv:en&&f(v.displacementMap.channel),emissiveMapUv:Fe&&f(v.emissiveMap.channel),metalnessMapUv:Ci&&f(v.metalnessMap.channel),roughnessMapUv:Pi&&f(v.roughnessMap.channel),anisotropyMapUv:Ut&&f(v.anisotropyMap.channel),clearcoatMapUv:I&&f(v.clearcoatMap.channel),clearcoatNormalMapUv:T&&f(v.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:X&&f(v.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ot&&f(v.diffuseRoughnessMap.channel),iridescenceMapUv:nt&&f(v.iridescenceMap.channel),iridescenceThicknessMapUv:dt&&f(v.iridescenceThicknessMap.channel),sheenColorMapUv:xt&&f(v.sheenColorMap.channel),sheenRoughnessMapUv:K&&f(v.sheenRoughnessMap.channel),specularMapUv:tt&&f(v.specularMap.channel),specularColorMapUv:pt&&f(v.specularColorMap.channel),specularIntensityMapUv:z&&f(v.specularIntensityMap.channel),transmissionMapUv:it&&f(v.transmissionMap.channel),thicknessMapUv:J&&f(v.thicknessMap.channel),alphaMapUv:ht&&f(v.alphaMap.channel),vertexTangents:!!N.attributes.tangent&&(be||Ii),vertexNormals:!!N.attributes.normal,vertexColors:v.vertexColors,vertexAlphas:v.vertexColors===!0&&!!N.attributes.color&&N.attributes.color.itemSize===4,pointsUvs:L.isPoints===!0&&!!N.attributes.uv&&(Nt||ht),fog:!!U,useFog:v.fog===!0,fogExp2:!!U&&U.isFogExp2,flatShading:v.wireframe===!1&&(v.flatShading===!0||N.attributes.normal===void 0&&be===!1&&(v.isMeshLambertMaterial||v.isMeshPhongMaterial||v.isMeshStandardMaterial||v.isMeshPhysicalMaterial)),sizeAttenuation:v.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:at,skinning:L.isSkinnedMesh===!0,hasPositionAttribute:N.attributes.position!==void 0,morphTargets:N.morphAttributes.position!==void 0,morphNormals:N.morphAttributes.normal!==void 0,morphColors:N.morphAttributes.color!==void 0,morphTargetsCount:Z,morphTextureStride:ct,numSunLights:w.sun.length,numDirLights:w.directional.length,numPointLights:w.point.length,numSpotLights:w.spot.length,numSpotLightMaps:w.spotLightMap.length,numRectAreaLights:w.rectArea.length,numHemiLights:w.hemi.length,numSunLightShadows:w.sunShadowMap.length,numDirLightShadows:w.directionalShadowMap.length,numPointLightShadows:w.pointShadowMap.length,numSpotLightShadows:w.spotShadowMap.length,numSpotLightShadowsWithMaps:w.numSpotLightShadowsWithMaps,numLightProbes:w.numLightProbes,numLightProbeGrids:D.filter(vt=>vt.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:v.dithering,shadowMapEnabled:s.shadowMap.enabled&&E.length>0,shadowMapType:s.shadowMap.type,toneMapping:lt,decodeVideoTexture:Nt&&v.map.isVideoTexture===!0&&Ht.getTransfer(v.map.colorSpace)===ne,decodeVideoTextureEmissive:Fe&&v.emissiveMap.isVideoTexture===!0&&Ht.getTransfer(v.emissiveMap.colorSpace)===ne,premultipliedAlpha:v.premultipliedAlpha,doubleSided:v.side===si,flipSided:v.side===ui,useDepthPacking:v.depthPacking>=0,depthPacking:v.depthPacking||0,index0AttributeName:v.index0AttributeName,extensionClipCullDistance:Xt&&v.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Xt&&v.extensions.multiDraw===!0||le)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:v.customProgramCacheKey()};return Gt.vertexUv1s=l.has(1),Gt.vertexUv2s=l.has(2),Gt.vertexUv3s=l.has(3),l.clear(),Gt}function x(v){let w=[];if(v.shaderID?w.push(v.shaderID):(w.push(v.customVertexShaderID),w.push(v.customFragmentShaderID)),v.defines!==void 0)for(let E in v.defines)w.push(E),w.push(v.defines[E]);return v.isRawShaderMaterial===!1&&(p(w,v),g(w,v),w.push(s.outputColorSpace)),w.push(v.customProgramCacheKey),w.join()}function p(v,w){v.push(w.precision),v.push(w.outputColorSpace),v.push(w.envMapMode),v.push(w.envMapPMREM),v.push(w.envMapMaxLod),v.push(w.envMapSize),v.push(w.mapUv),v.push(w.alphaMapUv),v.push(w.lightMapUv),v.push(w.aoMapUv),v.push(w.bumpMapUv),v.push(w.normalMapUv),v.push(w.displacementMapUv),v.push(w.emissiveMapUv),v.push(w.metalnessMapUv),v.push(w.roughnessMapUv),v.push(w.anisotropyMapUv),v.push(w.clearcoatMapUv),v.push(w.clearcoatNormalMapUv),v.push(w.clearcoatRoughnessMapUv),v.push(w.diffuseRoughnessMapUv),v.push(w.iridescenceMapUv),v.push(w.iridescenceThicknessMapUv),v.push(w.sheenColorMapUv),v.push(w.sheenRoughnessMapUv),v.push(w.specularMapUv),v.push(w.specularColorMapUv),v.push(w.specularIntensityMapUv),v.push(w.transmissionMapUv),v.push(w.thicknessMapUv),v.push(w.combine),v.push(w.fogExp2),v.push(w.sizeAttenuation),v.push(w.morphTargetsCount),v.push(w.numSunLights),v.push(w.numDirLights),v.push(w.numPointLights),v.push(w.numSpotLights),v.push(w.numSpotLightMaps),v.push(w.numHemiLights),v.push(w.numRectAreaLights),v.push(w.numSunLightShadows),v.push(w.numDirLightShadows),v.push(w.numPointLightShadows),v.push(w.numSpotLightShadows),v.push(w.numSpotLightShadowsWithMaps),v.push(w.numLightProbes),v.push(w.numLightProbeGrids),v.push(w.shadowMapType),v.push(w.toneMapping),v.push(w.numClippingPlanes),v.push(w.numClipIntersection),v.push(w.depthPacking)}function g(v,w){o.disableAll(),w.instancing&&o.enable(0),w.instancingColor&&o.enable(1),w.instancingMorph&&o.enable(2),w.matcap&&o.enable(3),w.envMap&&o.enable(4),w.normalMapObjectSpace&&o.enable(5),w.normalMapTangentSpace&&o.enable(6),w.clearcoat&&o.enable(7),w.iridescence&&o.enable(8),w.alphaTest&&o.enable(9),w.vertexColors&&o.enable(10),w.vertexAlphas&&o.enable(11),w.vertexUv1s&&o.enable(12),w.vertexUv2s&&o.enable(13),w.vertexUv3s&&o.enable(14),w.vertexTangents&&o.enable(15),w.anisotropy&&o.enable(16),w.alphaHash&&o.enable(17),w.batching&&o.enable(18),w.dispersion&&o.enable(19),w.retroreflection&&o.enable(24),w.diffuseRoughness&&o.enable(25),w.batchingColor&&o.enable(20),w.gradientMap&&o.enable(21),w.packedNormalMap&&o.enable(22),w.vertexNormals&&o.enable(23),v.push(o.mask),o.disableAll(),w.fog&&o.enable(0),w.useFog&&o.enable(1),w.flatShading&&o.enable(2),w.logarithmicDepthBuffer&&o.enable(3),w.reversedDepthBuffer&&o.enable(4),w.skinning&&o.enable(5),w.morphTargets&&o.enable(6),w.morphNormals&&o.enable(7),w.morphColors&&o.enable(8),w.premultipliedAlpha&&o.enable(9),w.shadowMapEnabled&&o.enable(10),w.doubleSided&&o.enable(11),w.flipSided&&o.enable(12),w.useDepthPacking&&o.enable(13),w.dithering&&o.enable(14),w.transmission&&o.enable(15),w.sheen&&o.enable(16),w.opaque&&o.enable(17),w.pointsUvs&&o.enable(18),w.decodeVideoTexture&&o.enable(19),w.decodeVideoTextureEmissive&&o.enable(20),w.alphaToCoverage&&o.enable(21),w.numLightProbeGrids>0&&o.enable(22),w.hasPositionAttribute&&o.enable(23),v.push(o.mask)}function _(v){let w=d[v.type],E;if(w){let R=dn[w];E=dp.clone(R.uniforms)}else E=v.uniforms;return E}function b(v,w){let E=h.get(w);return E!==void 0?++E.usedTimes:(E=new Mb(s,w,v,n),c.push(E),h.set(w,E)),E}function y(v){if(--v.usedTimes===0){let w=c.indexOf(v);c[w]=c[c.length-1],c.pop(),h.delete(v.cacheKey),v.destroy()}}function M(v){a.remove(v)}function S(){a.dispose()}return{getParameters:m,getProgramCacheKey:x,getUniforms:_,acquireProgram:b,releaseProgram:y,releaseShaderCache:M,programs:c,dispose:S}}function Rb(){let s=new WeakMap;function t(o){return s.has(o)}function e(o){let a=s.get(o);return a===void 0&&(a={},s.set(o,a)),a}function i(o){s.delete(o)}function n(o,a,l){s.get(o)[a]=l}function r(){s=new WeakMap}return{has:t,get:e,remove:i,update:n,dispose:r}}function Cb(s,t){return s.groupOrder!==t.groupOrder?s.groupOrder-t.groupOrder:s.renderOrder!==t.renderOrder?s.renderOrder-t.renderOrder:s.material.id!==t.material.id?s.material.id-t.material.id:s.materialVariant!==t.materialVariant?s.materialVariant-t.materialVariant:s.z!==t.z?s.z-t.z:s.id-t.id}function Ip(s,t){return s.groupOrder!==t.groupOrder?s.groupOrder-t.groupOrder:s.renderOrder!==t.renderOrder?s.renderOrder-t.renderOrder:s.z!==t.z?t.z-s.z:s.id-t.id}function Lp(){let s=[],t=0,e=[],i=[],n=[];function r(){t=0,e.length=0,i.length=0,n.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,m,x,p,g){let _=s[t];return _===void 0?(_={id:d.id,object:d,geometry:f,material:m,materialVariant:o(d),groupOrder:x,renderOrder:d.renderOrder,z:p,group:g},s[t]=_):(_.id=d.id,_.object=d,_.geometry=f,_.material=m,_.materialVariant=o(d),_.groupOrder=x,_.renderOrder=d.renderOrder,_.z=p,_.group=g),t++,_}function l(d,f,m,x,p,g,_){_.reversedDepth===!0&&(p=-p);let b=a(d,f,m,x,p,g);m.transmission>0?i.push(b):m.transparent===!0?n.push(b):e.push(b)}function c(d,f,m,x,p,g){let _=a(d,f,m,x,p,g);m.transmission>0?i.unshift(_):m.transparent===!0?n.unshift(_):e.unshift(_)}function h(d,f){e.length>1&&e.sort(d||Cb),i.length>1&&i.sort(f||Ip),n.length>1&&n.sort(f||Ip)}function u(){for(let d=t,f=s.length;d<f;d++){let m=s[d];if(m.id===null)break;m.id=null,m.object=null,m.geometry=null,m.material=null,m.group=null}}return{opaque:e,transmissive:i,transparent:n,init:r,push:l,unshift:c,finish:u,sort:h}}function Pb(){let s=new WeakMap;function t(i,n){let r=s.get(i),o;return r===void 0?(o=new Lp,s.set(i,[o])):n>=r.length?(o=new Lp,r.push(o)):o=r[n],o}function e(){s=new WeakMap}return{get:t,dispose:e}}function Ib(){let s={};return{get:function(t){if(s[t.id]!==void 0)return s[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new C,color:new It};break;case"SpotLight":e={position:new C,direction:new C,color:new It,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new C,color:new It,distance:0,decay:0};break;case"HemisphereLight":e={direction:new C,skyColor:new It,groundColor:new It};break;case"RectAreaLight":e={color:new It,position:new C,halfWidth:new C,halfHeight:new C};break}return s[t.id]=e,e}}}function Lb(){let s={};return{get:function(t){if(s[t.id]!==void 0)return s[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Rt};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Rt};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Rt,shadowCameraNear:1,shadowCameraFar:1e3};break}return s[t.id]=e,e}}}var Nb=0;function Db(s,t){return(t.castShadow?2:0)-(s.castShadow?2:0)+(t.map?1:0)-(s.map?1:0)}function zb(s){let t=new Ib,e=Lb(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)i.probe.push(new C);let n=new C,r=new wt,o=new wt;function a(c){let h=0,u=0,d=0;for(let D=0;D<9;D++)i.probe[D].set(0,0,0);let f=0,m=0,x=0,p=0,g=0,_=0,b=0,y=0,M=0,S=0,v=0,w=0,E=0,R=0;c.sort(Db);for(let D=0,U=c.length;D<U;D++){let N=c[D],V=N.color,k=N.intensity,B=N.distance,Y=null;if(N.shadow&&N.shadow.map&&(N.shadow.map.texture.format===Kn?Y=N.shadow.map.texture:Y=N.shadow.map.depthTexture||N.shadow.map.texture),N.isAmbientLight)h+=V.r*k,u+=V.g*k,d+=V.b*k;else if(N.isLightProbe){for(let H=0;H<9;H++)i.probe[H].addScaledVector(N.sh.coefficients[H],k);R++}else if(N.isSunLight){let H=t.get(N);if(H.color.copy(N.color).multiplyScalar(N.intensity),N.castShadow){let $=N.shadow,Z=e.get(N);Z.shadowIntensity=$.intensity,Z.shadowBias=$.bias,Z.shadowNormalBias=$.normalBias,Z.shadowRadius=$.radius,Z.shadowMapSize.copy($.mapSize).multiply($.getFrameExtents()),i.sunShadow[m]=Z,i.sunShadowMap[m]=Y;let ct=$.getViewportCount();for(let ut=0;ut<ct;ut++)i.sunShadowMatrix[x+ut]=$.getMatrix(ut),i.sunShadowCascade[x+ut]=$._cascadeData[ut];x+=ct,m++}i.sun[f]=H,f++}else if(N.isDirectionalLight){let H=t.get(N);if(H.color.copy(N.color).multiplyScalar(N.intensity),N.castShadow){let $=N.shadow,Z=e.get(N);Z.shadowIntensity=$.intensity,Z.shadowBias=$.bias,Z.shadowNormalBias=$.normalBias,Z.shadowRadius=$.radius,Z.shadowMapSize=$.mapSize,i.directionalShadow[p]=Z,i.directionalShadowMap[p]=Y,i.directionalShadowMatrix[p]=N.shadow.matrix,M++}i.directional[p]=H,p++}else if(N.isSpotLight){let H=t.get(N);H.position.setFromMatrixPosition(N.matrixWorld),H.color.copy(V).multiplyScalar(k),H.distance=B,H.coneCos=Math.cos(N.angle),H.penumbraCos=Math.cos(N.angle*(1-N.penumbra)),H.decay=N.decay,i.spot[_]=H;let $=N.shadow;if(N.map&&(i.spotLightMap[w]=N.map,w++,$.updateMatrices(N),N.castShadow&&E++),i.spotLightMatrix[_]=$.matrix,N.castShadow){let Z=e.get(N);Z.shadowIntensity=$.intensity,Z.shadowBias=$.bias,Z.shadowNormalBias=$.normalBias,Z.shadowRadius=$.radius,Z.shadowMapSize=$.mapSize,i.spotShadow[_]=Z,i.spotShadowMap[_]=Y,v++}_++}else if(N.isRectAreaLight){let H=t.get(N);H.color.copy(V).multiplyScalar(k),H.halfWidth.set(N.width*.5,0,0),H.halfHeight.set(0,N.height*.5,0),i.rectArea[b]=H,b++}else if(N.isPointLight){let H=t.get(N);if(H.color.copy(N.color).multiplyScalar(N.intensity),H.distance=N.distance,H.decay=N.decay,N.castShadow){let $=N.shadow,Z=e.get(N);Z.shadowIntensity=$.intensity,Z.shadowBias=$.bias,Z.shadowNormalBias=$.normalBias,Z.shadowRadius=$.radius,Z.shadowMapSize=$.mapSize,Z.shadowCameraNear=$.camera.near,Z.shadowCameraFar=$.camera.far,i.pointShadow[g]=Z,i.pointShadowMap[g]=Y,i.pointShadowMatrix[g]=N.shadow.matrix,S++}i.point[g]=H,g++}else if(N.isHemisphereLight){let H=t.get(N);H.skyColor.copy(N.color).multiplyScalar(k),H.groundColor.copy(N.groundColor).multiplyScalar(k),i.hemi[y]=H,y++}}b>0&&(s.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=bt.LTC_FLOAT_1,i.rectAreaLTC2=bt.LTC_FLOAT_2):(i.rectAreaLTC1=bt.LTC_HALF_1,i.rectAreaLTC2=bt.LTC_HALF_2)),i.ambient[0]=h,i.ambient[1]=u,i.ambient[2]=d;let L=i.hash;(L.sunLength!==f||L.directionalLength!==p||L.pointLength!==g||L.spotLength!==_||L.rectAreaLength!==b||L.hemiLength!==y||L.numSunShadows!==m||L.numDirectionalShadows!==M||L.numPointShadows!==S||L.numSpotShadows!==v||L.numSpotMaps!==w||L.numLightProbes!==R)&&(i.sun.length=f,i.directional.length=p,i.spot.length=_,i.rectArea.length=b,i.point.length=g,i.hemi.length=y,i.sunShadow.length=m,i.sunShadowMap.length=m,i.sunShadowMatrix.length=x,i.sunShadowCascade.length=x,i.directionalShadow.length=M,i.directionalShadowMap.length=M,i.directionalShadowMatrix.length=M,i.pointShadow.length=S,i.pointShadowMap.length=S,i.pointShadowMatrix.length=S,i.spotShadow.length=v,i.spotShadowMap.length=v,i.spotLightMatrix.length=v+w-E,i.spotLightMap.length=w,i.numSpotLightShadowsWithMaps=E,i.numLightProbes=R,L.sunLength=f,L.directionalLength=p,L.pointLength=g,L.spotLength=_,L.rectAreaLength=b,L.hemiLength=y,L.numSunShadows=m,L.numDirectionalShadows=M,L.numPointShadows=S,L.numSpotShadows=v,L.numSpotMaps=w,L.numLightProbes=R,i.version=Nb++)}function l(c,h){let u=0,d=0,f=0,m=0,x=0,p=0,g=h.matrixWorldInverse;for(let _=0,b=c.length;_<b;_++){let y=c[_];if(y.isSunLight){let M=i.sun[u];M.direction.setFromMatrixPosition(y.matrixWorld),M.direction.transformDirection(g),u++}else if(y.isDirectionalLight){let M=i.directional[d];M.direction.setFromMatrixPosition(y.matrixWorld),n.setFromMatrixPosition(y.target.matrixWorld),M.direction.sub(n),M.direction.transformDirection(g),d++}else if(y.isSpotLight){let M=i.spot[m];M.position.setFromMatrixPosition(y.matrixWorld),M.position.applyMatrix4(g),M.direction.setFromMatrixPosition(y.matrixWorld),n.setFromMatrixPosition(y.target.matrixWorld),M.direction.sub(n),M.direction.transformDirection(g),m++}else if(y.isRectAreaLight){let M=i.rectArea[x];M.position.setFromMatrixPosition(y.matrixWorld),M.position.applyMatrix4(g),o.identity(),r.copy(y.matrixWorld),r.premultiply(g),o.extractRotation(r),M.halfWidth.set(y.width*.5,0,0),M.halfHeight.set(0,y.height*.5,0),M.halfWidth.applyMatrix4(o),M.halfHeight.applyMatrix4(o),x++}else if(y.isPointLight){let M=i.point[f];M.position.setFromMatrixPosition(y.matrixWorld),M.position.applyMatrix4(g),f++}else if(y.isHemisphereLight){let M=i.hemi[p];M.direction.setFromMatrixPosition(y.matrixWorld),M.direction.transformDirection(g),p++}}}return{setup:a,setupView:l,state:i}}function Np(s){let t=new zb(s),e=[],i=[],n=[];function r(u){h.camera=u,e.length=0,i.length=0,n.length=0}function o(u){u.isLightProbeGrid?n.push(u):e.push(u)}function a(u){i.push(u)}function l(){t.setup(e),n.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:i,lightProbeGridArray:n,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function kb(s){let t=new WeakMap;function e(n,r=0){let o=t.get(n),a;return o===void 0?(a=new Np(s),t.set(n,[a])):r>=o.length?(a=new Np(s),o.push(a)):a=o[r],a}function i(){t=new WeakMap}return{get:e,dispose:i}}var Fb=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,Ob=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,Ub=[new C(1,0,0),new C(-1,0,0),new C(0,1,0),new C(0,-1,0),new C(0,0,1),new C(0,0,-1)],Bb=[new C(0,-1,0),new C(0,-1,0),new C(0,0,1),new C(0,0,-1),new C(0,-1,0),new C(0,-1,0)],Dp=new wt,Do=new C,Au=new C;function Vb(s,t,e){let i=new Wn,n=new Rt,r=new Rt,o=new ae,a=new Ja,l=new Ka,c={},h=e.maxTextureSize,u={[cn]:ui,[ui]:cn,[si]:si},d=new an({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Rt},radius:{value:4}},vertexShader:Fb,fragmentShader:Ob}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let m=new ce;m.setAttribute("position",new pi(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let x=new st(m,d),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Mo;let g=this.type;this.render=function(S,v,w){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||S.length===0)return;this.type===Sf&&(Pt("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Mo);let E=s.getRenderTarget(),R=s.getActiveCubeFace(),L=s.getActiveMipmapLevel(),D=s.state;D.setBlending(Ps),D.buffers.depth.getReversed()===!0?D.buffers.color.setClear(0,0,0,0):D.buffers.color.setClear(1,1,1,1),D.buffers.depth.setTest(!0),D.setScissorTest(!1);let U=g!==this.type;U&&v.traverse(function(N){N.material&&(Array.isArray(N.material)?N.material.forEach(V=>V.needsUpdate=!0):N.material.needsUpdate=!0)});for(let N=0,V=S.length;N<V;N++){let k=S[N],B=k.shadow;if(B===void 0){Pt("WebGLShadowMap:",k,"has no shadow.");continue}if(B.autoUpdate===!1&&B.needsUpdate===!1)continue;n.copy(B.mapSize);let Y=B.getFrameExtents();n.multiply(Y),r.copy(B.mapSize),(n.x>h||n.y>h)&&(n.x>h&&(r.x=Math.floor(h/Y.x),n.x=r.x*Y.x,B.mapSize.x=r.x),n.y>h&&(r.y=Math.floor(h/Y.y),n.y=r.y*Y.y,B.mapSize.y=r.y));let H=s.state.buffers.depth.getReversed();if(B.camera._reversedDepth=H,B.map===null||U===!0){if(B.map!==null&&(B.map.depthTexture!==null&&(B.map.depthTexture.dispose(),B.map.depthTexture=null),B.map.dispose()),this.type===wr){if(k.isPointLight){Pt("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}B.map=new Ri(n.x,n.y,{format:Kn,type:Ji,minFilter:Ve,magFilter:Ve,generateMipmaps:!1}),B.map.texture.name=k.name+".shadowMap",B.map.depthTexture=new Rn(n.x,n.y,Fi),B.map.depthTexture.name=k.name+".shadowMapDepth",B.map.depthTexture.format=Tn,B.map.depthTexture.compareFunction=null,B.map.depthTexture.minFilter=He,B.map.depthTexture.magFilter=He}else k.isPointLight?(B.map=new ko(n.x),B.map.depthTexture=new co(n.x,Zi)):(B.map=new Ri(n.x,n.y),B.map.depthTexture=new Rn(n.x,n.y,Zi)),B.map.depthTexture.name=k.name+".shadowMap",B.map.depthTexture.format=Tn,this.type===Mo?(B.map.depthTexture.compareFunction=H?pu:fu,B.map.depthTexture.minFilter=Ve,B.map.depthTexture.magFilter=Ve):(B.map.depthTexture.compareFunction=null,B.map.depthTexture.minFilter=He,B.map.depthTexture.magFilter=He);B.camera.updateProjectionMatrix()}B.map.isWebGLCubeRenderTarget!==!0&&(B.map.width!==n.x||B.map.height!==n.y)&&B.map.setSize(n.x,n.y);let $=B.map.isWebGLCubeRenderTarget?6:B.getViewportCount();k.isPointLight!==!0&&B.updateMatrices(k,w);let Z=(B.camera.layers.mask&4294967294)!==0?B.camera.layers:w.layers;for(let ct=0;ct<$;ct++){let ut=B.getCamera(ct);if(k.isPointLight){let G=B.camera,Q=B.matrix,et=k.distance||G.far;et!==G.far&&(G.far=et,G.updateProjectionMatrix()),Do.setFromMatrixPosition(k.matrixWorld),G.position.copy(Do),Au.copy(G.position),Au.add(Ub[ct]),G.up.copy(Bb[ct]),G.lookAt(Au),G.updateMatrixWorld(),Q.makeTranslation(-Do.x,-Do.y,-Do.z),Dp.multiplyMatrices(G.projectionMatrix,G.matrixWorldInverse),B._frustum.setFromProjectionMatrix(Dp,G.coordinateSystem,G.reversedDepth)}if(B.map.isWebGLCubeRenderTarget)s.setRenderTarget(B.map,ct),s.clear();else{ct===0&&(s.setRenderTarget(B.map),s.clear());let G=B.getViewport(ct);o.set(r.x*G.x,r.y*G.y,r.x*G.z,r.y*G.w),D.viewport(o)}i=B.getFrustum(ct),y(v,w,ut,k,Z,this.type)}B.isPointLightShadow!==!0&&this.type===wr&&_(B,w),B.needsUpdate=!1}g=this.type,p.needsUpdate=!1,s.setRenderTarget(E,R,L)};function _(S,v){let w=t.update(x);d.defines.VSM_SAMPLES!==S.blurSamples&&(d.defines.VSM_SAMPLES=S.blurSamples,f.defines.VSM_SAMPLES=S.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),S.mapPass===null?S.mapPass=new Ri(n.x,n.y,{format:Kn,type:Ji}):(S.mapPass.width!==S.map.width||S.mapPass.height!==S.map.height)&&S.mapPass.setSize(S.map.width,S.map.height),d.uniforms.shadow_pass.value=S.map.depthTexture,d.uniforms.resolution.value.set(S.map.width,S.map.height),d.uniforms.radius.value=S.radius,s.setRenderTarget(S.mapPass),s.clear(),s.renderBufferDirect(v,null,w,d,x,null),f.uniforms.shadow_pass.value=S.mapPass.texture,f.uniforms.resolution.value.set(S.map.width,S.map.height),f.uniforms.radius.value=S.radius,s.setRenderTarget(S.map),s.clear(),s.renderBufferDirect(v,null,w,f,x,null)}function b(S,v,w,E){let R=null,L=w.isPointLight===!0?S.customDistanceMaterial:S.customDepthMaterial;if(L!==void 0)R=L;else if(R=w.isPointLight===!0?l:a,s.localClippingEnabled&&v.clipShadows===!0&&Array.isArray(v.clippingPlanes)&&v.clippingPlanes.length!==0||v.displacementMap&&v.displacementScale!==0||v.alphaMap&&v.alphaTest>0||v.map&&v.alphaTest>0||v.alphaToCoverage===!0){let D=R.uuid,U=v.uuid,N=c[D];N===void 0&&(N={},c[D]=N);let V=N[U];V===void 0&&(V=R.clone(),N[U]=V,v.addEventListener("dispose",M)),R=V}if(R.visible=v.visible,R.wireframe=v.wireframe,E===wr?R.side=v.shadowSide!==null?v.shadowSide:v.side:R.side=v.shadowSide!==null?v.shadowSide:u[v.side],R.alphaMap=v.alphaMap,R.alphaTest=v.alphaToCoverage===!0?.5:v.alphaTest,R.map=v.map,R.clipShadows=v.clipShadows,R.clippingPlanes=v.clippingPlanes,R.clipIntersection=v.clipIntersection,R.displacementMap=v.displacementMap,R.displacementScale=v.displacementScale,R.displacementBias=v.displacementBias,R.wireframeLinewidth=v.wireframeLinewidth,R.linewidth=v.linewidth,w.isPointLight===!0&&R.isMeshDistanceMaterial===!0){let D=s.properties.get(R);D.light=w}return R}function y(S,v,w,E,R,L){if(S.visible===!1)return;if(S.layers.test(R)&&(S.isMesh||S.isLine||S.isPoints)&&(S.castShadow||S.receiveShadow&&L===wr)&&(!S.frustumCulled||S.intersectsFrustum(i))){S.modelViewMatrix.multiplyMatrices(w.matrixWorldInverse,S.matrixWorld);let N=t.update(S),V=S.material;if(Array.isArray(V)){let k=N.groups;for(let B=0,Y=k.length;B<Y;B++){let H=k[B],$=V[H.materialIndex];if($&&$.visible){let Z=b(S,$,E,L);S.onBeforeShadow(s,S,v,w,N,Z,H),s.renderBufferDirect(w,null,N,Z,S,H),S.onAfterShadow(s,S,v,w,N,Z,H)}}}else if(V.visible){let k=b(S,V,E,L);S.onBeforeShadow(s,S,v,w,N,k,null),s.renderBufferDirect(w,null,N,k,S,null),S.onAfterShadow(s,S,v,w,N,k,null)}}let U=S.children;for(let N=0,V=U.length;N<V;N++)y(U[N],v,w,E,R,L)}function M(S){S.target.removeEventListener("dispose",M);for(let w in c){let E=c[w],R=S.target.uuid;R in E&&(E[R].dispose(),delete E[R])}}}function Hb(s,t){function e(){let z=!1,it=new ae,J=null,mt=new ae(0,0,0,0);return{setMask:function(ht){J!==ht&&!z&&(s.colorMask(ht,ht,ht,ht),J=ht)},setLocked:function(ht){z=ht},setClear:function(ht,ft,Ct,Xt,lt){lt===!0&&(ht*=Xt,ft*=Xt,Ct*=Xt),it.set(ht,ft,Ct,Xt),mt.equals(it)===!1&&(s.clearColor(ht,ft,Ct,Xt),mt.copy(it))},reset:function(){z=!1,J=null,mt.set(-1,0,0,0)}}}function i(){let z=!1,it=!1,J=null,mt=null,ht=null;return{setReversed:function(ft){if(it!==ft){let Ct=t.get("EXT_clip_control");ft?Ct.clipControlEXT(Ct.LOWER_LEFT_EXT,Ct.ZERO_TO_ONE_EXT):Ct.clipControlEXT(Ct.LOWER_LEFT_EXT,Ct.NEGATIVE_ONE_TO_ONE_EXT),it=ft;let Xt=ht;ht=null,this.setClear(Xt)}},getReversed:function(){return it},setTest:function(ft){ft?at(s.DEPTH_TEST):Lt(s.DEPTH_TEST)},setMask:function(ft){J!==ft&&!z&&(s.depthMask(ft),J=ft)},setFunc:function(ft){if(it&&(ft=sp[ft]),mt!==ft){switch(ft){case Da:s.depthFunc(s.NEVER);break;case za:s.depthFunc(s.ALWAYS);break;case ka:s.depthFunc(s.LESS);break;case lr:s.depthFunc(s.LEQUAL);break;case Fa:s.depthFunc(s.EQUAL);break;case Oa:s.depthFunc(s.GEQUAL);break;case Ua:s.depthFunc(s.GREATER);break;case Ba:s.depthFunc(s.NOTEQUAL);break;default:s.depthFunc(s.LEQUAL)}mt=ft}},setLocked:function(ft){z=ft},setClear:function(ft){ht!==ft&&(ht=ft,it&&(ft=1-ft),s.clearDepth(ft))},reset:function(){z=!1,J=null,mt=null,ht=null,it=!1}}}function n(){let z=!1,it=null,J=null,mt=null,ht=null,ft=null,Ct=null,Xt=null,lt=null;return{setTest:function(Dt){z||(Dt?at(s.STENCIL_TEST):Lt(s.STENCIL_TEST))},setMask:function(Dt){it!==Dt&&!z&&(s.stencilMask(Dt),it=Dt)},setFunc:function(Dt,Gt,vt){(J!==Dt||mt!==Gt||ht!==vt)&&(s.stencilFunc(Dt,Gt,vt),J=Dt,mt=Gt,ht=vt)},setOp:function(Dt,Gt,vt){(ft!==Dt||Ct!==Gt||Xt!==vt)&&(s.stencilOp(Dt,Gt,vt),ft=Dt,Ct=Gt,Xt=vt)},setLocked:function(Dt){z=Dt},setClear:function(Dt){lt!==Dt&&(s.clearStencil(Dt),lt=Dt)},reset:function(){z=!1,it=null,J=null,mt=null,ht=null,ft=null,Ct=null,Xt=null,lt=null}}}let r=new e,o=new i,a=new n,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,m=[],x=null,p=!1,g=null,_=null,b=null,y=null,M=null,S=null,v=null,w=new It(0,0,0),E=0,R=!1,L=null,D=null,U=null,N=null,V=null,k=s.getParameter(s.MAX_COMBINED_TEXTURE_IMAGE_UNITS),B=!1,Y=0,H=s.getParameter(s.VERSION);H.indexOf("WebGL")!==-1?(Y=parseFloat(/^WebGL (\d)/.exec(H)[1]),B=Y>=1):H.indexOf("OpenGL ES")!==-1&&(Y=parseFloat(/^OpenGL ES (\d)/.exec(H)[1]),B=Y>=2);let $=null,Z={},ct=s.getParameter(s.SCISSOR_BOX),ut=s.getParameter(s.VIEWPORT),G=new ae().fromArray(ct),Q=new ae().fromArray(ut);function et(z,it,J,mt){let ht=new Uint8Array(4),ft=s.createTexture();s.bindTexture(z,ft),s.texParameteri(z,s.TEXTURE_MIN_FILTER,s.NEAREST),s.texParameteri(z,s.TEXTURE_MAG_FILTER,s.NEAREST);for(let Ct=0;Ct<J;Ct++)z===s.TEXTURE_3D||z===s.TEXTURE_2D_ARRAY?s.texImage3D(it,0,s.RGBA,1,1,mt,0,s.RGBA,s.UNSIGNED_BYTE,ht):s.texImage2D(it+Ct,0,s.RGBA,1,1,0,s.RGBA,s.UNSIGNED_BYTE,ht);return ft}let rt={};rt[s.TEXTURE_2D]=et(s.TEXTURE_2D,s.TEXTURE_2D,1),rt[s.TEXTURE_CUBE_MAP]=et(s.TEXTURE_CUBE_MAP,s.TEXTURE_CUBE_MAP_POSITIVE_X,6),rt[s.TEXTURE_2D_ARRAY]=et(s.TEXTURE_2D_ARRAY,s.TEXTURE_2D_ARRAY,1,1),rt[s.TEXTURE_3D]=et(s.TEXTURE_3D,s.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),at(s.DEPTH_TEST),o.setFunc(lr),fi(!1),be(qh),at(s.CULL_FACE),qe(Ps);function at(z){h[z]!==!0&&(s.enable(z),h[z]=!0)}function Lt(z){h[z]!==!1&&(s.disable(z),h[z]=!1)}function le(z,it){return d[z]!==it?(s.bindFramebuffer(z,it),d[z]=it,z===s.DRAW_FRAMEBUFFER&&(d[s.FRAMEBUFFER]=it),z===s.FRAMEBUFFER&&(d[s.DRAW_FRAMEBUFFER]=it),!0):!1}function Nt(z,it){let J=m,mt=!1;if(z){J=f.get(it),J===void 0&&(J=[],f.set(it,J));let ht=z.textures;if(J.length!==ht.length||J[0]!==s.COLOR_ATTACHMENT0){for(let ft=0,Ct=ht.length;ft<Ct;ft++)J[ft]=s.COLOR_ATTACHMENT0+ft;J.length=ht.length,mt=!0}}else J[0]!==s.BACK&&(J[0]=s.BACK,mt=!0);mt&&s.drawBuffers(J)}function se(z){return x!==z?(s.useProgram(z),x=z,!0):!1}let he={[Is]:s.FUNC_ADD,[Mf]:s.FUNC_SUBTRACT,[Tf]:s.FUNC_REVERSE_SUBTRACT};he[Af]=s.MIN,he[Ef]=s.MAX;let Yt={[Rf]:s.ZERO,[Cf]:s.ONE,[Pf]:s.SRC_COLOR,[Zh]:s.SRC_ALPHA,[kf]:s.SRC_ALPHA_SATURATE,[Df]:s.DST_COLOR,[Lf]:s.DST_ALPHA,[If]:s.ONE_MINUS_SRC_COLOR,[Jh]:s.ONE_MINUS_SRC_ALPHA,[zf]:s.ONE_MINUS_DST_COLOR,[Nf]:s.ONE_MINUS_DST_ALPHA,[Ff]:s.CONSTANT_COLOR,[Of]:s.ONE_MINUS_CONSTANT_COLOR,[Uf]:s.CONSTANT_ALPHA,[Bf]:s.ONE_MINUS_CONSTANT_ALPHA};function qe(z,it,J,mt,ht,ft,Ct,Xt,lt,Dt){if(z===Ps){p===!0&&(Lt(s.BLEND),p=!1);return}if(p===!1&&(at(s.BLEND),p=!0),z!==wf){if(z!==g||Dt!==R){if((_!==Is||M!==Is)&&(s.blendEquation(s.FUNC_ADD),_=Is,M=Is),Dt)switch(z){case Mr:s.blendFuncSeparate(s.ONE,s.ONE_MINUS_SRC_ALPHA,s.ONE,s.ONE_MINUS_SRC_ALPHA);break;case jh:s.blendFunc(s.ONE,s.ONE);break;case Yh:s.blendFuncSeparate(s.ZERO,s.ONE_MINUS_SRC_COLOR,s.ZERO,s.ONE);break;case $h:s.blendFuncSeparate(s.DST_COLOR,s.ONE_MINUS_SRC_ALPHA,s.ZERO,s.ONE);break;default:kt("WebGLState: Invalid blending: ",z);break}else switch(z){case Mr:s.blendFuncSeparate(s.SRC_ALPHA,s.ONE_MINUS_SRC_ALPHA,s.ONE,s.ONE_MINUS_SRC_ALPHA);break;case jh:s.blendFuncSeparate(s.SRC_ALPHA,s.ONE,s.ONE,s.ONE);break;case Yh:kt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case $h:kt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:kt("WebGLState: Invalid blending: ",z);break}b=null,y=null,S=null,v=null,w.set(0,0,0),E=0,g=z,R=Dt}return}ht=ht||it,ft=ft||J,Ct=Ct||mt,(it!==_||ht!==M)&&(s.blendEquationSeparate(he[it],he[ht]),_=it,M=ht),(J!==b||mt!==y||ft!==S||Ct!==v)&&(s.blendFuncSeparate(Yt[J],Yt[mt],Yt[ft],Yt[Ct]),b=J,y=mt,S=ft,v=Ct),(Xt.equals(w)===!1||lt!==E)&&(s.blendColor(Xt.r,Xt.g,Xt.b,lt),w.copy(Xt),E=lt),g=z,R=!1}function Ie(z,it){z.side===si?Lt(s.CULL_FACE):at(s.CULL_FACE);let J=z.side===ui;it&&(J=!J),fi(J),z.blending===Mr&&z.transparent===!1?qe(Ps):qe(z.blending,z.blendEquation,z.blendSrc,z.blendDst,z.blendEquationAlpha,z.blendSrcAlpha,z.blendDstAlpha,z.blendColor,z.blendAlpha,z.premultipliedAlpha),o.setFunc(z.depthFunc),o.setTest(z.depthTest),o.setMask(z.depthWrite),r.setMask(z.colorWrite);let mt=z.stencilWrite;a.setTest(mt),mt&&(a.setMask(z.stencilWriteMask),a.setFunc(z.stencilFunc,z.stencilRef,z.stencilFuncMask),a.setOp(z.stencilFail,z.stencilZFail,z.stencilZPass)),Fe(z.polygonOffset,z.polygonOffsetFactor,z.polygonOffsetUnits),z.alphaToCoverage===!0?at(s.SAMPLE_ALPHA_TO_COVERAGE):Lt(s.SAMPLE_ALPHA_TO_COVERAGE)}function fi(z){L!==z&&(z?s.frontFace(s.CW):s.frontFace(s.CCW),L=z)}function be(z){z!==vf?(at(s.CULL_FACE),z!==D&&(z===qh?s.cullFace(s.BACK):z===bf?s.cullFace(s.FRONT):s.cullFace(s.FRONT_AND_BACK))):Lt(s.CULL_FACE),D=z}function en(z){z!==U&&(B&&s.lineWidth(z),U=z)}function Fe(z,it,J){z?(at(s.POLYGON_OFFSET_FILL),(N!==it||V!==J)&&(N=it,V=J,o.getReversed()&&(it=-it,J=-J),s.polygonOffset(it,J))):Lt(s.POLYGON_OFFSET_FILL)}function Ci(z){z?at(s.SCISSOR_TEST):Lt(s.SCISSOR_TEST)}function Pi(z){z===void 0&&(z=s.TEXTURE0+k-1),$!==z&&(s.activeTexture(z),$=z)}function Ii(z,it,J){J===void 0&&($===null?J=s.TEXTURE0+k-1:J=$);let mt=Z[J];mt===void 0&&(mt={type:void 0,texture:void 0},Z[J]=mt),(mt.type!==z||mt.texture!==it)&&($!==J&&(s.activeTexture(J),$=J),s.bindTexture(z,it||rt[z]),mt.type=z,mt.texture=it)}function O(){let z=Z[$];z!==void 0&&z.type!==void 0&&(s.bindTexture(z.type,null),z.type=void 0,z.texture=void 0)}function Li(){try{s.compressedTexImage2D(...arguments)}catch(z){kt("WebGLState:",z)}}function ge(){try{s.compressedTexImage3D(...arguments)}catch(z){kt("WebGLState:",z)}}function xe(){try{s.texSubImage2D(...arguments)}catch(z){kt("WebGLState:",z)}}function _t(){try{s.texSubImage3D(...arguments)}catch(z){kt("WebGLState:",z)}}function Le(){try{s.compressedTexSubImage2D(...arguments)}catch(z){kt("WebGLState:",z)}}function zt(){try{s.compressedTexSubImage3D(...arguments)}catch(z){kt("WebGLState:",z)}}function Ut(){try{s.texStorage2D(...arguments)}catch(z){kt("WebGLState:",z)}}function I(){try{s.texStorage3D(...arguments)}catch(z){kt("WebGLState:",z)}}function T(){try{s.texImage2D(...arguments)}catch(z){kt("WebGLState:",z)}}function X(){try{s.texImage3D(...arguments)}catch(z){kt("WebGLState:",z)}}function ot(z){return u[z]!==void 0?u[z]:s.getParameter(z)}function nt(z,it){u[z]!==it&&(s.pixelStorei(z,it),u[z]=it)}function dt(z){G.equals(z)===!1&&(s.scissor(z.x,z.y,z.z,z.w),G.copy(z))}function xt(z){Q.equals(z)===!1&&(s.viewport(z.x,z.y,z.z,z.w),Q.copy(z))}function K(z,it){let J=c.get(it);J===void 0&&(J=new WeakMap,c.set(it,J));let mt=J.get(z);mt===void 0&&(mt=s.getUniformBlockIndex(it,z.name),s.uniformBlockBinding(it,mt,mt),J.set(z,mt))}function tt(z,it,J){let ht=c.get(it).get(z);l[ht]!==J&&(s.bindBufferBase(s.UNIFORM_BUFFER,ht,J),l[ht]=J)}function pt(){s.disable(s.BLEND),s.disable(s.CULL_FACE),s.disable(s.DEPTH_TEST),s.disable(s.POLYGON_OFFSET_FILL),s.disable(s.SCISSOR_TEST),s.disable(s.STENCIL_TEST),s.disable(s.SAMPLE_ALPHA_TO_COVERAGE),s.blendEquation(s.FUNC_ADD),s.blendFunc(s.ONE,s.ZERO),s.blendFuncSeparate(s.ONE,s.ZERO,s.ONE,s.ZERO),s.blendColor(0,0,0,0),s.colorMask(!0,!0,!0,!0),s.clearColor(0,0,0,0),s.depthMask(!0),s.depthFunc(s.LESS),o.setReversed(!1),s.clearDepth(1),s.stencilMask(4294967295),s.stencilFunc(s.ALWAYS,0,4294967295),s.stencilOp(s.KEEP,s.KEEP,s.KEEP),s.clearStencil(0),s.cullFace(s.BACK),s.frontFace(s.CCW),s.polygonOffset(0,0),s.activeTexture(s.TEXTURE0),s.bindFramebuffer(s.FRAMEBUFFER,null),s.bindFramebuffer(s.DRAW_FRAMEBUFFER,null),s.bindFramebuffer(s.READ_FRAMEBUFFER,null),s.useProgram(null),s.lineWidth(1),s.scissor(0,0,s.canvas.width,s.canvas.height),s.viewport(0,0,s.canvas.width,s.canvas.height),s.pixelStorei(s.PACK_ALIGNMENT,4),s.pixelStorei(s.UNPACK_ALIGNMENT,4),s.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,!1),s.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),s.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,s.BROWSER_DEFAULT_WEBGL),s.pixelStorei(s.PACK_ROW_LENGTH,0),s.pixelStorei(s.PACK_SKIP_PIXELS,0),s.pixelStorei(s.PACK_SKIP_ROWS,0),s.pixelStorei(s.UNPACK_ROW_LENGTH,0),s.pixelStorei(s.UNPACK_IMAGE_HEIGHT,0),s.pixelStorei(s.UNPACK_SKIP_PIXELS,0),s.pixelStorei(s.UNPACK_SKIP_ROWS,0),s.pixelStorei(s.UNPACK_SKIP_IMAGES,0),h={},u={},$=null,Z={},d={},l={},f=new WeakMap,m=[],x=null,p=!1,g=null,_=null,b=null,y=null,M=null,S=null,v=null,w=new It(0,0,0),E=0,R=!1,L=null,D=null,U=null,N=null,V=null,G.set(0,0,s.canvas.width,s.canvas.height),Q.set(0,0,s.canvas.width,s.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:at,disable:Lt,bindFramebuffer:le,drawBuffers:Nt,useProgram:se,setBlending:qe,setMaterial:Ie,setFlipSided:fi,setCullFace:be,setLineWidth:en,setPolygonOffset:Fe,setScissorTest:Ci,activeTexture:Pi,bindTexture:Ii,unbindTexture:O,compressedTexImage2D:Li,compressedTexImage3D:ge,texImage2D:T,texImage3D:X,pixelStorei:nt,getParameter:ot,updateUBOMapping:K,uniformBlockBinding:tt,texStorage2D:Ut,texStorage3D:I,texSubImage2D:xe,texSubImage3D:_t,compressedTexSubImage2D:Le,compressedTexSubImage3D:zt,scissor:dt,viewport:xt,reset:pt}}function Gb(s,t,e,i,n,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new Rt,h=new WeakMap,u=new Set,d,f=new WeakMap,m=new Set,x=new FinalizationRegistry(I=>m.delete(I)),p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(I,T){return p?new OffscreenCanvas(I,T):hr("canvas")}function _(I,T,X){let ot=1,nt=Ut(I);if((nt.width>X||nt.height>X)&&(ot=X/Math.max(nt.width,nt.height)),ot<1)if(typeof HTMLImageElement<"u"&&I instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&I instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&I instanceof ImageBitmap||typeof VideoFrame<"u"&&I instanceof VideoFrame){let dt=Math.floor(ot*nt.width),xt=Math.floor(ot*nt.height);d===void 0&&(d=g(dt,xt));let K=T?g(dt,xt):d;return K.width=dt,K.height=xt,K.getContext("2d").drawImage(I,0,0,dt,xt),Pt("WebGLRenderer: Texture has been resized from ("+nt.width+"x"+nt.height+") to ("+dt+"x"+xt+")."),K}else return"data"in I&&Pt("WebGLRenderer: Image in DataTexture is too big ("+nt.width+"x"+nt.height+")."),I;return I}function b(I){return I.generateMipmaps}function y(I){s.generateMipmap(I)}function M(I){return I.isWebGLCubeRenderTarget?s.TEXTURE_CUBE_MAP:I.isWebGL3DRenderTarget?s.TEXTURE_3D:I.isWebGLArrayRenderTarget||I.isCompressedArrayTexture?s.TEXTURE_2D_ARRAY:s.TEXTURE_2D}function S(I,T,X,ot,nt,dt=!1){if(I!==null){if(s[I]!==void 0)return s[I];Pt("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+I+"'")}let xt;ot&&(xt=t.get("EXT_texture_norm16"),xt||Pt("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let K=T;if(T===s.RED&&(X===s.FLOAT&&(K=s.R32F),X===s.HALF_FLOAT&&(K=s.R16F),X===s.UNSIGNED_BYTE&&(K=s.R8),X===s.UNSIGNED_SHORT&&xt&&(K=xt.R16_EXT),X===s.SHORT&&xt&&(K=xt.R16_SNORM_EXT)),T===s.RED_INTEGER&&(X===s.UNSIGNED_BYTE&&(K=s.R8UI),X===s.UNSIGNED_SHORT&&(K=s.R16UI),X===s.UNSIGNED_INT&&(K=s.R32UI),X===s.BYTE&&(K=s.R8I),X===s.SHORT&&(K=s.R16I),X===s.INT&&(K=s.R32I)),T===s.RG&&(X===s.FLOAT&&(K=s.RG32F),X===s.HALF_FLOAT&&(K=s.RG16F),X===s.UNSIGNED_BYTE&&(K=s.RG8),X===s.UNSIGNED_SHORT&&xt&&(K=xt.RG16_EXT),X===s.SHORT&&xt&&(K=xt.RG16_SNORM_EXT)),T===s.RG_INTEGER&&(X===s.UNSIGNED_BYTE&&(K=s.RG8UI),X===s.UNSIGNED_SHORT&&(K=s.RG16UI),X===s.UNSIGNED_INT&&(K=s.RG32UI),X===s.BYTE&&(K=s.RG8I),X===s.SHORT&&(K=s.RG16I),X===s.INT&&(K=s.RG32I)),T===s.RGB_INTEGER&&(X===s.UNSIGNED_BYTE&&(K=s.RGB8UI),X===s.UNSIGNED_SHORT&&(K=s.RGB16UI),X===s.UNSIGNED_INT&&(K=s.RGB32UI),X===s.BYTE&&(K=s.RGB8I),X===s.SHORT&&(K=s.RGB16I),X===s.INT&&(K=s.RGB32I)),T===s.RGBA_INTEGER&&(X===s.UNSIGNED_BYTE&&(K=s.RGBA8UI),X===s.UNSIGNED_SHORT&&(K=s.RGBA16UI),X===s.UNSIGNED_INT&&(K=s.RGBA32UI),X===s.BYTE&&(K=s.RGBA8I),X===s.SHORT&&(K=s.RGBA16I),X===s.INT&&(K=s.RGBA32I)),T===s.RGB&&(X===s.UNSIGNED_SHORT&&xt&&(K=xt.RGB16_EXT),X===s.SHORT&&xt&&(K=xt.RGB16_SNORM_EXT),X===s.UNSIGNED_INT_5_9_9_9_REV&&(K=s.RGB9_E5),X===s.UNSIGNED_INT_10F_11F_11F_REV&&(K=s.R11F_G11F_B10F)),T===s.RGBA){let tt=dt?eo:Ht.getTransfer(nt);X===s.FLOAT&&(K=s.RGBA32F),X===s.HALF_FLOAT&&(K=s.RGBA16F),X===s.UNSIGNED_BYTE&&(K=tt===ne?s.SRGB8_ALPHA8:s.RGBA8),X===s.UNSIGNED_SHORT&&xt&&(K=xt.RGBA16_EXT),X===s.SHORT&&xt&&(K=xt.RGBA16_SNORM_EXT),X===s.UNSIGNED_SHORT_4_4_4_4&&(K=s.RGBA4),X===s.UNSIGNED_SHORT_5_5_5_1&&(K=s.RGB5_A1)}return(K===s.R16F||K===s.R32F||K===s.RG16F||K===s.RG32F||K===s.RGBA16F||K===s.RGBA32F)&&t.get("EXT_color_buffer_float"),K}function v(I,T){let X;return I?T===null||T===Zi||T===Ns?X=s.DEPTH24_STENCIL8:T===Fi?X=s.DEPTH32F_STENCIL8:T===Ar&&(X=s.DEPTH24_STENCIL8,Pt("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):T===null||T===Zi||T===Ns?X=s.DEPTH_COMPONENT24:T===Fi?X=s.DEPTH_COMPONENT32F:T===Ar&&(X=s.DEPTH_COMPONENT16),X}function w(I,T){return b(I)===!0||I.isFramebufferTexture&&I.minFilter!==He&&I.minFilter!==Ve?Math.log2(Math.max(T.width,T.height))+1:I.mipmaps.length>0?I.mipmaps.length:I.isCompressedTexture&&Array.isArray(I.image)?T.mipmaps.length:1}function E(I){let T=new WeakRef(I);i.get(I).__ref=T,m.add(T),x.register(I,T,T)}function R(I){let T=i.get(I).__ref;T!==void 0&&(m.delete(T),x.unregister(T))}function L(I){U(I.target)}function D(I){N(I.target)}function U(I){I.removeEventListener("dispose",L),R(I),k(I),I.isVideoTexture&&h.delete(I),I.isHTMLTexture&&u.delete(I)}function N(I){I.removeEventListener("dispose",D),R(I),Y(I)}function V(){for(let I of m){let T=I.deref();T!==void 0&&(T.isRenderTarget===!0?N(T):U(T))}m.clear(),u.clear()}function k(I){let T=i.get(I);if(T.__webglInit===void 0)return;let X=I.source,ot=f.get(X);if(ot){let nt=ot[T.__cacheKey];nt.usedTimes--,nt.usedTimes===0&&B(I),Object.keys(ot).length===0&&f.delete(X)}i.remove(I)}function B(I){let T=i.get(I);s.deleteTexture(T.__webglTexture);let X=I.source,ot=f.get(X);delete ot[T.__cacheKey],o.memory.textures--}function Y(I){let T=i.get(I);T.__depthDisposeCallback&&T.__depthDisposeCallback();let X=I.depthTexture;if(X&&X.renderTarget===I&&U(X),I.isWebGLCubeRenderTarget)for(let nt=0;nt<6;nt++){if(Array.isArray(T.__webglFramebuffer[nt]))for(let dt=0;dt<T.__webglFramebuffer[nt].length;dt++)s.deleteFramebuffer(T.__webglFramebuffer[nt][dt]);else s.deleteFramebuffer(T.__webglFramebuffer[nt]);T.__webglDepthbuffer&&s.deleteRenderbuffer(T.__webglDepthbuffer[nt])}else{if(Array.isArray(T.__webglFramebuffer))for(let nt=0;nt<T.__webglFramebuffer.length;nt++)s.deleteFramebuffer(T.__webglFramebuffer[nt]);else s.deleteFramebuffer(T.__webglFramebuffer);if(T.__webglDepthbuffer&&s.deleteRenderbuffer(T.__webglDepthbuffer),T.__webglMultisampledFramebuffer&&s.deleteFramebuffer(T.__webglMultisampledFramebuffer),T.__webglColorRenderbuffer)for(let nt=0;nt<T.__webglColorRenderbuffer.length;nt++)T.__webglColorRenderbuffer[nt]&&s.deleteRenderbuffer(T.__webglColorRenderbuffer[nt]);T.__webglDepthRenderbuffer&&s.deleteRenderbuffer(T.__webglDepthRenderbuffer)}let ot=I.textures;for(let nt=0,dt=ot.length;nt<dt;nt++){let xt=i.get(ot[nt]);xt.__webglTexture&&(s.deleteTexture(xt.__webglTexture),o.memory.textures--),i.remove(ot[nt])}i.remove(I)}let H=0;function $(){H=0}function Z(){return H}function ct(I){H=I}function ut(){let I=H;return I>=n.maxTextures&&Pt("WebGLTextures: Trying to use "+(I+1)+" texture units while this GPU supports only "+n.maxTextures),H+=1,I}function G(I){let T=[];return T.push(I.wrapS),T.push(I.wrapT),T.push(I.wrapR||0),T.push(I.magFilter),T.push(I.minFilter),T.push(I.anisotropy),T.push(I.internalFormat),T.push(I.format),T.push(I.type),T.push(I.generateMipmaps),T.push(I.mipmapsAutoUpdate),T.push(I.premultiplyAlpha),T.push(I.flipY),T.push(I.unpackAlignment),T.push(I.colorSpace),T.join()}function Q(I,T){let X=i.get(I);if(I.isVideoTexture&&Le(I),I.isRenderTargetTexture===!1&&I.isExternalTexture!==!0&&I.version>0&&X.__version!==I.version){let ot=I.image;if(ot===null)Pt("WebGLRenderer: Texture marked for update but no image data found.");else if(ot.complete===!1)Pt("WebGLRenderer: Texture marked for update but image is incomplete");else{Ie(X,I,T);return}}else I.isExternalTexture&&(X.__webglTexture=I.sourceTexture?I.sourceTexture:null);e.bindTexture(s.TEXTURE_2D,X.__webglTexture,s.TEXTURE0+T)}function et(I,T){let X=i.get(I);if(I.isRenderTargetTexture===!1&&I.version>0&&X.__version!==I.version){Ie(X,I,T);return}else I.isExternalTexture&&(X.__webglTexture=I.sourceTexture?I.sourceTexture:null);e.bindTexture(s.TEXTURE_2D_ARRAY,X.__webglTexture,s.TEXTURE0+T)}function rt(I,T){let X=i.get(I);if(I.isRenderTargetTexture===!1&&I.version>0&&X.__version!==I.version){Ie(X,I,T);return}e.bindTexture(s.TEXTURE_3D,X.__webglTexture,s.TEXTURE0+T)}function at(I,T){let X=i.get(I);if(I.version>0&&X.__version!==I.version){fi(X,I,T);return}e.bindTexture(s.TEXTURE_CUBE_MAP,X.__webglTexture,s.TEXTURE0+T)}let Lt={[Mn]:s.REPEAT,[ci]:s.CLAMP_TO_EDGE,[Va]:s.MIRRORED_REPEAT},le={[He]:s.NEAREST,[Wf]:s.NEAREST_MIPMAP_NEAREST,[Ao]:s.NEAREST_MIPMAP_LINEAR,[Ve]:s.LINEAR,[ll]:s.LINEAR_MIPMAP_NEAREST,[ki]:s.LINEAR_MIPMAP_LINEAR},Nt={[$f]:s.NEVER,[mu]:s.ALWAYS,[Zf]:s.LESS,[fu]:s.LEQUAL,[Jf]:s.EQUAL,[pu]:s.GEQUAL,[Kf]:s.GREATER,[Qf]:s.NOTEQUAL};function se(I,T){if(T.type===Fi&&t.has("OES_texture_float_linear")===!1&&(T.magFilter===Ve||T.magFilter===ll||T.magFilter===Ao||T.magFilter===ki||T.minFilter===Ve||T.minFilter===ll||T.minFilter===Ao||T.minFilter===ki)&&Pt("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),s.texParameteri(I,s.TEXTURE_WRAP_S,Lt[T.wrapS]),s.texParameteri(I,s.TEXTURE_WRAP_T,Lt[T.wrapT]),(I===s.TEXTURE_3D||I===s.TEXTURE_2D_ARRAY)&&s.texParameteri(I,s.TEXTURE_WRAP_R,Lt[T.wrapR]),s.texParameteri(I,s.TEXTURE_MAG_FILTER,le[T.magFilter]),s.texParameteri(I,s.TEXTURE_MIN_FILTER,le[T.minFilter]),T.compareFunction&&(s.texParameteri(I,s.TEXTURE_COMPARE_MODE,s.COMPARE_REF_TO_TEXTURE),s.texParameteri(I,s.TEXTURE_COMPARE_FUNC,Nt[T.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(T.magFilter===He||T.minFilter!==Ao&&T.minFilter!==ki||T.type===Fi&&t.has("OES_texture_float_linear")===!1)return;if(T.anisotropy>1||i.get(T).__currentAnisotropy){let X=t.get("EXT_texture_filter_anisotropic");s.texParameterf(I,X.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(T.anisotropy,n.getMaxAnisotropy())),i.get(T).__currentAnisotropy=T.anisotropy}}}function he(I,T){let X=!1;I.__webglInit===void 0&&(I.__webglInit=!0,T.addEventListener("dispose",L),E(T));let ot=T.source,nt=f.get(ot);nt===void 0&&(nt={},f.set(ot,nt));let dt=G(T);if(dt!==I.__cacheKey){nt[dt]===void 0&&(nt[dt]={texture:s.createTexture(),usedTimes:0},o.memory.textures++,X=!0),nt[dt].usedTimes++;let xt=nt[I.__cacheKey];xt!==void 0&&(nt[I.__cacheKey].usedTimes--,xt.usedTimes===0&&B(T)),I.__cacheKey=dt,I.__webglTexture=nt[dt].texture}return X}function Yt(I,T,X){return Math.floor(Math.floor(I/X)/T)}function qe(I,T,X,ot){let dt=I.updateRanges;if(dt.length===0)e.texSubImage2D(s.TEXTURE_2D,0,0,0,T.width,T.height,X,ot,T.data);else{dt.sort((z,it)=>z.start-it.start);let xt=0;for(let z=1;z<dt.length;z++){let it=dt[xt],J=dt[z],mt=it.start+it.count,ht=Yt(J.start,T.width,4),ft=Yt(it.start,T.width,4);J.start<=mt+1&&ht===ft&&Yt(J.start+J.count-1,T.width,4)===ht?it.count=Math.max(it.count,J.start+J.count-it.start):(++xt,dt[xt]=J)}dt.length=xt+1;let K=e.getParameter(s.UNPACK_ROW_LENGTH),tt=e.getParameter(s.UNPACK_SKIP_PIXELS),pt=e.getParameter(s.UNPACK_SKIP_ROWS);e.pixelStorei(s.UNPACK_ROW_LENGTH,T.width);for(let z=0,it=dt.length;z<it;z++){let J=dt[z],mt=Math.floor(J.start/4),ht=Math.ceil(J.count/4),ft=mt%T.width,Ct=Math.floor(mt/T.width),Xt=ht,lt=1;e.pixelStorei(s.UNPACK_SKIP_PIXELS,ft),e.pixelStorei(s.UNPACK_SKIP_ROWS,Ct),e.texSubImage2D(s.TEXTURE_2D,0,ft,Ct,Xt,lt,X,ot,T.data)}I.clearUpdateRanges(),e.pixelStorei(s.UNPACK_ROW_LENGTH,K),e.pixelStorei(s.UNPACK_SKIP_PIXELS,tt),e.pixelStorei(s.UNPACK_SKIP_ROWS,pt)}}function Ie(I,T,X){let ot=s.TEXTURE_2D;(T.isDataArrayTexture||T.isCompressedArrayTexture)&&(ot=s.TEXTURE_2D_ARRAY),T.isData3DTexture&&(ot=s.TEXTURE_3D);let nt=he(I,T),dt=T.source;e.bindTexture(ot,I.__webglTexture,s.TEXTURE0+X);let xt=i.get(dt);if(dt.version!==xt.__version||nt===!0){if(e.activeTexture(s.TEXTURE0+X),(typeof ImageBitmap<"u"&&T.image instanceof ImageBitmap)===!1){let lt=Ht.getPrimaries(Ht.workingColorSpace),Dt=T.colorSpace===Nn?null:Ht.getPrimaries(T.colorSpace),Gt=T.colorSpace===Nn||lt===Dt?s.NONE:s.BROWSER_DEFAULT_WEBGL;e.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,T.flipY),e.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,T.premultiplyAlpha),e.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,Gt)}e.pixelStorei(s.UNPACK_ALIGNMENT,T.unpackAlignment);let tt=_(T.image,!1,n.maxTextureSize);tt=zt(T,tt);let pt=r.convert(T.format,T.colorSpace),z=r.convert(T.type),it=S(T.internalFormat,pt,z,T.normalized,T.colorSpace,T.isVideoTexture);se(ot,T);let J,mt=T.mipmaps,ht=T.isVideoTexture!==!0,ft=xt.__version===void 0||nt===!0,Ct=dt.dataReady,Xt=w(T,tt);if(T.isDepthTexture)it=v(T.format===Ln,T.type),ft&&(ht?e.texStorage2D(s.TEXTURE_2D,1,it,tt.width,tt.height):e.texImage2D(s.TEXTURE_2D,0,it,tt.width,tt.height,0,pt,z,null));else if(T.isDataTexture)if(mt.length>0){ht&&ft&&e.texStorage2D(s.TEXTURE_2D,Xt,it,mt[0].width,mt[0].height);for(let lt=0,Dt=mt.length;lt<Dt;lt++)J=mt[lt],ht?Ct&&e.texSubImage2D(s.TEXTURE_2D,lt,0,0,J.width,J.height,pt,z,J.data):e.texImage2D(s.TEXTURE_2D,lt,it,J.width,J.height,0,pt,z,J.data);T.generateMipmaps=!1}else ht?(ft&&e.texStorage2D(s.TEXTURE_2D,Xt,it,tt.width,tt.height),Ct&&qe(T,tt,pt,z)):e.texImage2D(s.TEXTURE_2D,0,it,tt.width,tt.height,0,pt,z,tt.data);else if(T.isCompressedTexture)if(T.isCompressedArrayTexture){ht&&ft&&e.texStorage3D(s.TEXTURE_2D_ARRAY,Xt,it,mt[0].width,mt[0].height,tt.depth);for(let lt=0,Dt=mt.length;lt<Dt;lt++)if(J=mt[lt],T.format!==Oi)if(pt!==null)if(ht){if(Ct)if(T.layerUpdates.size>0){let Gt=Mu(J.width,J.height,T.format,T.type);for(let vt of T.layerUpdates){let re=J.data.subarray(vt*Gt/J.data.BYTES_PER_ELEMENT,(vt+1)*Gt/J.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(s.TEXTURE_2D_ARRAY,lt,0,0,vt,J.width,J.height,1,pt,re)}}else e.compressedTexSubImage3D(s.TEXTURE_2D_ARRAY,lt,0,0,0,J.width,J.height,tt.depth,pt,J.data)}else e.compressedTexImage3D(s.TEXTURE_2D_ARRAY,lt,it,J.width,J.height,tt.depth,0,J.data,0,0);else Pt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else ht?Ct&&e.texSubImage3D(s.TEXTURE_2D_ARRAY,lt,0,0,0,J.width,J.height,tt.depth,pt,z,J.data):e.texImage3D(s.TEXTURE_2D_ARRAY,lt,it,J.width,J.height,tt.depth,0,pt,z,J.data);T.layerUpdates.size>0&&T.clearLayerUpdates()}else{ht&&ft&&e.texStorage2D(s.TEXTURE_2D,Xt,it,mt[0].width,mt[0].height);for(let lt=0,Dt=mt.length;lt<Dt;lt++)J=mt[lt],T.format!==Oi?pt!==null?ht?Ct&&e.compressedTexSubImage2D(s.TEXTURE_2D,lt,0,0,J.width,J.height,pt,J.data):e.compressedTexImage2D(s.TEXTURE_2D,lt,it,J.width,J.height,0,J.data):Pt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):ht?Ct&&e.texSubImage2D(s.TEXTURE_2D,lt,0,0,J.width,J.height,pt,z,J.data):e.texImage2D(s.TEXTURE_2D,lt,it,J.width,J.height,0,pt,z,J.data)}else if(T.isDataArrayTexture)if(ht){if(ft&&e.texStorage3D(s.TEXTURE_2D_ARRAY,Xt,it,tt.width,tt.height,tt.depth),Ct)if(T.layerUpdates.size>0){let lt=Mu(tt.width,tt.height,T.format,T.type);for(let Dt of T.layerUpdates){let Gt=tt.data.subarray(Dt*lt/tt.data.BYTES_PER_ELEMENT,(Dt+1)*lt/tt.data.BYTES_PER_ELEMENT);e.texSubImage3D(s.TEXTURE_2D_ARRAY,0,0,0,Dt,tt.width,tt.height,1,pt,z,Gt)}T.clearLayerUpdates()}else e.texSubImage3D(s.TEXTURE_2D_ARRAY,0,0,0,0,tt.width,tt.height,tt.depth,pt,z,tt.data)}else e.texImage3D(s.TEXTURE_2D_ARRAY,0,it,tt.width,tt.height,tt.depth,0,pt,z,tt.data);else if(T.isData3DTexture)ht?(ft&&e.texStorage3D(s.TEXTURE_3D,Xt,it,tt.width,tt.height,tt.depth),Ct&&e.texSubImage3D(s.TEXTURE_3D,0,0,0,0,tt.width,tt.height,tt.depth,pt,z,tt.data)):e.texImage3D(s.TEXTURE_3D,0,it,tt.width,tt.height,tt.depth,0,pt,z,tt.data);else if(T.isFramebufferTexture){if(ft)if(ht)e.texStorage2D(s.TEXTURE_2D,Xt,it,tt.width,tt.height);else{let lt=tt.width,Dt=tt.height;for(let Gt=0;Gt<Xt;Gt++)e.texImage2D(s.TEXTURE_2D,Gt,it,lt,Dt,0,pt,z,null),lt>>=1,Dt>>=1}}else if(T.isHTMLTexture){if("texElementImage2D"in s){let lt=s.canvas;if(lt.hasAttribute("layoutsubtree")||lt.setAttribute("layoutsubtree","true"),tt.parentNode!==lt){lt.appendChild(tt),u.add(T),lt.onpaint=Dt=>{let Gt=Dt.changedElements;for(let vt of u)Gt.includes(vt.image)&&(vt.needsUpdate=!0)},lt.requestPaint();return}if(s.texElementImage2D.length===3)s.texElementImage2D(s.TEXTURE_2D,s.RGBA8,tt);else{let Gt=s.RGBA,vt=s.RGBA,re=s.UNSIGNED_BYTE;s.texElementImage2D(s.TEXTURE_2D,0,Gt,vt,re,tt)}s.texParameteri(s.TEXTURE_2D,s.TEXTURE_MIN_FILTER,s.LINEAR),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_S,s.CLAMP_TO_EDGE),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_T,s.CLAMP_TO_EDGE)}}else if(mt.length>0){if(ht&&ft){let lt=Ut(mt[0]);e.texStorage2D(s.TEXTURE_2D,Xt,it,lt.width,lt.height)}for(let lt=0,Dt=mt.length;lt<Dt;lt++)J=mt[lt],ht?Ct&&e.texSubImage2D(s.TEXTURE_2D,lt,0,0,pt,z,J):e.texImage2D(s.TEXTURE_2D,lt,it,pt,z,J);T.generateMipmaps=!1}else if(ht){if(ft){let lt=Ut(tt);e.texStorage2D(s.TEXTURE_2D,Xt,it,lt.width,lt.height)}Ct&&e.texSubImage2D(s.TEXTURE_2D,0,0,0,pt,z,tt)}else e.texImage2D(s.TEXTURE_2D,0,it,pt,z,tt);b(T)&&T.mipmapsAutoUpdate===!0&&y(ot),xt.__version=dt.version,T.onUpdate&&T.onUpdate(T)}I.__version=T.version}function fi(I,T,X){if(T.image.length!==6)return;let ot=he(I,T),nt=T.source;e.bindTexture(s.TEXTURE_CUBE_MAP,I.__webglTexture,s.TEXTURE0+X);let dt=i.get(nt);if(nt.version!==dt.__version||ot===!0){e.activeTexture(s.TEXTURE0+X);let xt=Ht.getPrimaries(Ht.workingColorSpace),K=T.colorSpace===Nn?null:Ht.getPrimaries(T.colorSpace),tt=T.colorSpace===Nn||xt===K?s.NONE:s.BROWSER_DEFAULT_WEBGL;e.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,T.flipY),e.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,T.premultiplyAlpha),e.pixelStorei(s.UNPACK_ALIGNMENT,T.unpackAlignment),e.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,tt);let pt=T.isCompressedTexture||T.image[0].isCompressedTexture,z=T.image[0]&&T.image[0].isDataTexture,it=[];for(let vt=0;vt<6;vt++)!pt&&!z?it[vt]=_(T.image[vt],!0,n.maxCubemapSize):it[vt]=z?T.image[vt].image:T.image[vt],it[vt]=zt(T,it[vt]);let J=it[0],mt=r.convert(T.format,T.colorSpace),ht=r.convert(T.type),ft=S(T.internalFormat,mt,ht,T.normalized,T.colorSpace),Ct=T.isVideoTexture!==!0,Xt=dt.__version===void 0||ot===!0,lt=nt.dataReady,Dt=w(T,J);se(s.TEXTURE_CUBE_MAP,T);let Gt;if(T.isDepthTexture){if(ft=v(T.format===Ln,T.type),Xt)if(Ct)e.texStorage2D(s.TEXTURE_CUBE_MAP,1,ft,J.width,J.height);else for(let vt=0;vt<6;vt++)e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,ft,J.width,J.height,0,mt,ht,null)}else if(pt){Ct&&Xt&&e.texStorage2D(s.TEXTURE_CUBE_MAP,Dt,ft,J.width,J.height);for(let vt=0;vt<6;vt++){Gt=it[vt].mipmaps;for(let re=0;re<Gt.length;re++){let Oe=Gt[re];T.format!==Oi?mt!==null?Ct?lt&&e.compressedTexSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,re,0,0,Oe.width,Oe.height,mt,Oe.data):e.compressedTexImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,re,ft,Oe.width,Oe.height,0,Oe.data):Pt("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Ct?lt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,re,0,0,Oe.width,Oe.height,mt,ht,Oe.data):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,re,ft,Oe.width,Oe.height,0,mt,ht,Oe.data)}}}else{if(Gt=T.mipmaps,Ct&&Xt){Gt.length>0&&Dt++;let vt=Ut(it[0]);e.texStorage2D(s.TEXTURE_CUBE_MAP,Dt,ft,vt.width,vt.height)}for(let vt=0;vt<6;vt++)if(z){Ct?lt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,0,0,it[vt].width,it[vt].height,mt,ht,it[vt].data):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,ft,it[vt].width,it[vt].height,0,mt,ht,it[vt].data);for(let re=0;re<Gt.length;re++){let kn=Gt[re].image[vt].image;Ct?lt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,re+1,0,0,kn.width,kn.height,mt,ht,kn.data):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,re+1,ft,kn.width,kn.height,0,mt,ht,kn.data)}}else{Ct?lt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,0,0,mt,ht,it[vt]):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,ft,mt,ht,it[vt]);for(let re=0;re<Gt.length;re++){let Oe=Gt[re];Ct?lt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,re+1,0,0,mt,ht,Oe.image[vt]):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,re+1,ft,mt,ht,Oe.image[vt])}}}b(T)&&T.mipmapsAutoUpdate===!0&&y(s.TEXTURE_CUBE_MAP),dt.__version=nt.version,T.onUpdate&&T.onUpdate(T)}I.__version=T.version}function be(I,T,X,ot,nt,dt){let xt=r.convert(X.format,X.colorSpace),K=r.convert(X.type),tt=S(X.internalFormat,xt,K,X.normalized,X.colorSpace),pt=i.get(T),z=i.get(X);if(z.__renderTarget=T,!pt.__hasExternalTextures){let it=Math.max(1,T.width>>dt),J=Math.max(1,T.height>>dt);nt===s.TEXTURE_3D||nt===s.TEXTURE_2D_ARRAY?e.texImage3D(nt,dt,tt,it,J,T.depth,0,xt,K,null):e.texImage2D(nt,dt,tt,it,J,0,xt,K,null)}e.bindFramebuffer(s.FRAMEBUFFER,I),_t(T)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,ot,nt,z.__webglTexture,0,xe(T)):(nt===s.TEXTURE_2D||nt>=s.TEXTURE_CUBE_MAP_POSITIVE_X&&nt<=s.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&s.framebufferTexture2D(s.FRAMEBUFFER,ot,nt,z.__webglTexture,dt),e.bindFramebuffer(s.FRAMEBUFFER,null)}function en(I,T,X){if(s.bindRenderbuffer(s.RENDERBUFFER,I),T.depthBuffer){let ot=T.depthTexture,nt=ot&&ot.isDepthTexture?ot.type:null,dt=v(T.stencilBuffer,nt),xt=T.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;_t(T)?a.renderbufferStorageMultisampleEXT(s.RENDERBUFFER,xe(T),dt,T.width,T.height):X?s.renderbufferStorageMultisample(s.RENDERBUFFER,xe(T),dt,T.width,T.height):s.renderbufferStorage(s.RENDERBUFFER,dt,T.width,T.height),s.framebufferRenderbuffer(s.FRAMEBUFFER,xt,s.RENDERBUFFER,I)}else{let ot=T.textures;for(let nt=0;nt<ot.length;nt++){let dt=ot[nt],xt=r.convert(dt.format,dt.colorSpace),K=r.convert(dt.type),tt=S(dt.internalFormat,xt,K,dt.normalized,dt.colorSpace);_t(T)?a.renderbufferStorageMultisampleEXT(s.RENDERBUFFER,xe(T),tt,T.width,T.height):X?s.renderbufferStorageMultisample(s.RENDERBUFFER,xe(T),tt,T.width,T.height):s.renderbufferStorage(s.RENDERBUFFER,tt,T.width,T.height)}}s.bindRenderbuffer(s.RENDERBUFFER,null)}function Fe(I,T,X){let ot=T.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(s.FRAMEBUFFER,I),!(T.depthTexture&&T.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let nt=i.get(T.depthTexture);nt.__renderTarget=T;let dt=ot?T.depthTexture.image[0]:T.depthTexture.image;(!nt.__webglTexture||dt.width!==T.width||dt.height!==T.height)&&(dt.width=T.width,dt.height=T.height,T.depthTexture.needsUpdate=!0),ot?at(T.depthTexture,0):Q(T.depthTexture,0);let xt=nt.__webglTexture,K=xe(T),tt=ot?s.TEXTURE_CUBE_MAP_POSITIVE_X+X:s.TEXTURE_2D,pt=T.depthTexture.format===Ln?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;if(T.depthTexture.format===Tn)_t(T)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,pt,tt,xt,0,K):s.framebufferTexture2D(s.FRAMEBUFFER,pt,tt,xt,0);else if(T.depthTexture.format===Ln)_t(T)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,pt,tt,xt,0,K):s.framebufferTexture2D(s.FRAMEBUFFER,pt,tt,xt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function Ci(I){let T=i.get(I),X=I.isWebGLCubeRenderTarget===!0;if(T.__boundDepthTexture!==I.depthTexture){let ot=I.depthTexture;if(T.__depthDisposeCallback&&T.__depthDisposeCallback(),ot){let nt=()=>{delete T.__boundDepthTexture,delete T.__depthDisposeCallback,ot.removeEventListener("dispose",nt)};ot.addEventListener("dispose",nt),T.__depthDisposeCallback=nt}T.__boundDepthTexture=ot}if(I.depthTexture&&!T.__autoAllocateDepthBuffer)if(X)for(let ot=0;ot<6;ot++)Fe(T.__webglFramebuffer[ot],I,ot);else I.texture.mipmaps.length>0?Fe(T.__webglFramebuffer[0],I,0):Fe(T.__webglFramebuffer,I,0);else if(X){T.__webglDepthbuffer=[];for(let ot=0;ot<6;ot++)if(e.bindFramebuffer(s.FRAMEBUFFER,T.__webglFramebuffer[ot]),T.__webglDepthbuffer[ot]===void 0)T.__webglDepthbuffer[ot]=s.createRenderbuffer(),en(T.__webglDepthbuffer[ot],I,!1);else{let nt=I.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,dt=T.__webglDepthbuffer[ot];s.bindRenderbuffer(s.RENDERBUFFER,dt),s.framebufferRenderbuffer(s.FRAMEBUFFER,nt,s.RENDERBUFFER,dt)}}else if(I.texture.mipmaps.length>0?e.bindFramebuffer(s.FRAMEBUFFER,T.__webglFramebuffer[0]):e.bindFramebuffer(s.FRAMEBUFFER,T.__webglFramebuffer),T.__webglDepthbuffer===void 0)T.__webglDepthbuffer=s.createRenderbuffer(),en(T.__webglDepthbuffer,I,!1);else{let nt=I.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,dt=T.__webglDepthbuffer;s.bindRenderbuffer(s.RENDERBUFFER,dt),s.framebufferRenderbuffer(s.FRAMEBUFFER,nt,s.RENDERBUFFER,dt)}e.bindFramebuffer(s.FRAMEBUFFER,null)}function Pi(I,T,X){let ot=i.get(I);T!==void 0&&be(ot.__webglFramebuffer,I,I.texture,s.COLOR_ATTACHMENT0,s.TEXTURE_2D,0),X!==void 0&&Ci(I)}function Ii(I){let T=I.texture,X=i.get(I),ot=i.get(T);I.addEventListener("dispose",D),E(I);let nt=I.textures,dt=I.isWebGLCubeRenderTarget===!0,xt=nt.length>1;if(xt||(ot.__webglTexture===void 0&&(ot.__webglTexture=s.createTexture()),ot.__version=T.version,o.memory.textures++),dt){X.__webglFramebuffer=[];for(let K=0;K<6;K++)if(T.mipmaps.length>0){X.__webglFramebuffer[K]=[];for(let tt=0;tt<T.mipmaps.length;tt++)X.__webglFramebuffer[K][tt]=s.createFramebuffer()}else X.__webglFramebuffer[K]=s.createFramebuffer()}else{if(T.mipmaps.length>0){X.__webglFramebuffer=[];for(let K=0;K<T.mipmaps.length;K++)X.__webglFramebuffer[K]=s.createFramebuffer()}else X.__webglFramebuffer=s.createFramebuffer();if(xt)for(let K=0,tt=nt.length;K<tt;K++){let pt=i.get(nt[K]);pt.__webglTexture===void 0&&(pt.__webglTexture=s.createTexture(),o.memory.textures++)}if(I.samples>0&&_t(I)===!1){X.__webglMultisampledFramebuffer=s.createFramebuffer(),X.__webglColorRenderbuffer=[],e.bindFramebuffer(s.FRAMEBUFFER,X.__webglMultisampledFramebuffer);for(let K=0;K<nt.length;K++){let tt=nt[K];X.__webglColorRenderbuffer[K]=s.createRenderbuffer(),s.bindRenderbuffer(s.RENDERBUFFER,X.__webglColorRenderbuffer[K]);let pt=r.convert(tt.format,tt.colorSpace),z=r.convert(tt.type),it=S(tt.internalFormat,pt,z,tt.normalized,tt.colorSpace,I.isXRRenderTarget===!0),J=xe(I);s.renderbufferStorageMultisample(s.RENDERBUFFER,J,it,I.width,I.height),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+K,s.RENDERBUFFER,X.__webglColorRenderbuffer[K])}s.bindRenderbuffer(s.RENDERBUFFER,null),I.depthBuffer&&(X.__webglDepthRenderbuffer=s.createRenderbuffer(),en(X.__webglDepthRenderbuffer,I,!0)),e.bindFramebuffer(s.FRAMEBUFFER,null)}}if(dt){e.bindTexture(s.TEXTURE_CUBE_MAP,ot.__webglTexture),se(s.TEXTURE_CUBE_MAP,T);for(let K=0;K<6;K++)if(T.mipmaps.length>0)for(let tt=0;tt<T.mipmaps.length;tt++)be(X.__webglFramebuffer[K][tt],I,T,s.COLOR_ATTACHMENT0,s.TEXTURE_CUBE_MAP_POSITIVE_X+K,tt);else be(X.__webglFramebuffer[K],I,T,s.COLOR_ATTACHMENT0,s.TEXTURE_CUBE_MAP_POSITIVE_X+K,0);b(T)?y(s.TEXTURE_CUBE_MAP):T.mipmaps.length>0&&s.texParameteri(s.TEXTURE_CUBE_MAP,s.TEXTURE_MAX_LEVEL,T.mipmaps.length-1),e.unbindTexture()}else if(xt){for(let K=0,tt=nt.length;K<tt;K++){let pt=nt[K],z=i.get(pt),it=s.TEXTURE_2D;(I.isWebGL3DRenderTarget||I.isWebGLArrayRenderTarget)&&(it=I.isWebGL3DRenderTarget?s.TEXTURE_3D:s.TEXTURE_2D_ARRAY),e.bindTexture(it,z.__webglTexture),se(it,pt),be(X.__webglFramebuffer,I,pt,s.COLOR_ATTACHMENT0+K,it,0),b(pt)&&y(it)}e.unbindTexture()}else{let K=s.TEXTURE_2D;if((I.isWebGL3DRenderTarget||I.isWebGLArrayRenderTarget)&&(K=I.isWebGL3DRenderTarget?s.TEXTURE_3D:s.TEXTURE_2D_ARRAY),e.bindTexture(K,ot.__webglTexture),se(K,T),T.mipmaps.length>0)for(let tt=0;tt<T.mipmaps.length;tt++)be(X.__webglFramebuffer[tt],I,T,s.COLOR_ATTACHMENT0,K,tt);else be(X.__webglFramebuffer,I,T,s.COLOR_ATTACHMENT0,K,0);b(T)?y(K):T.mipmaps.length>0&&s.texParameteri(K,s.TEXTURE_MAX_LEVEL,T.mipmaps.length-1),e.unbindTexture()}I.depthBuffer&&Ci(I)}function O(I){let T=I.textures;for(let X=0,ot=T.length;X<ot;X++){let nt=T[X];if(b(nt)&&nt.mipmapsAutoUpdate===!0){let dt=M(I),xt=i.get(nt).__webglTexture;e.bindTexture(dt,xt),y(dt),e.unbindTexture()}}}let Li=[];function ge(I){if(I.samples>0){if(_t(I)===!1){let T=I.textures,X=I.width,ot=I.height,nt=s.COLOR_BUFFER_BIT,dt=I.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,xt=i.get(I),K=T.length>1;if(K)for(let pt=0;pt<T.length;pt++)e.bindFramebuffer(s.FRAMEBUFFER,xt.__webglMultisampledFramebuffer),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+pt,s.RENDERBUFFER,null),e.bindFramebuffer(s.FRAMEBUFFER,xt.__webglFramebuffer),s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0+pt,s.TEXTURE_2D,null,0);e.bindFramebuffer(s.READ_FRAMEBUFFER,xt.__webglMultisampledFramebuffer),I.texture.mipmaps.length>0?e.bindFramebuffer(s.DRAW_FRAMEBUFFER,xt.__webglFramebuffer[0]):e.bindFramebuffer(s.DRAW_FRAMEBUFFER,xt.__webglFramebuffer);for(let pt=0;pt<T.length;pt++){if(I.resolveDepthBuffer&&(I.depthBuffer&&(nt|=s.DEPTH_BUFFER_BIT),I.stencilBuffer&&I.resolveStencilBuffer&&(nt|=s.STENCIL_BUFFER_BIT)),K){s.framebufferRenderbuffer(s.READ_FRAMEBUFFER,s.COLOR_ATTACHMENT0,s.RENDERBUFFER,xt.__webglColorRenderbuffer[pt]);let z=i.get(T[pt]).__webglTexture;s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0,s.TEXTURE_2D,z,0)}s.blitFramebuffer(0,0,X,ot,0,0,X,ot,nt,s.NEAREST),l===!0&&(Li.length=0,Li.push(s.COLOR_ATTACHMENT0+pt),I.depthBuffer&&I.storeMultisampledDepthBuffer===!1&&Li.push(dt),s.invalidateFramebuffer(s.READ_FRAMEBUFFER,Li))}if(e.bindFramebuffer(s.READ_FRAMEBUFFER,null),e.bindFramebuffer(s.DRAW_FRAMEBUFFER,null),K)for(let pt=0;pt<T.length;pt++){e.bindFramebuffer(s.FRAMEBUFFER,xt.__webglMultisampledFramebuffer),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+pt,s.RENDERBUFFER,xt.__webglColorRenderbuffer[pt]);let z=i.get(T[pt]).__webglTexture;e.bindFramebuffer(s.FRAMEBUFFER,xt.__webglFramebuffer),s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0+pt,s.TEXTURE_2D,z,0)}e.bindFramebuffer(s.DRAW_FRAMEBUFFER,xt.__webglMultisampledFramebuffer)}else if(I.depthBuffer&&I.storeMultisampledDepthBuffer===!1&&l){let T=I.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;s.invalidateFramebuffer(s.DRAW_FRAMEBUFFER,[T])}}}function xe(I){return Math.min(n.maxSamples,I.samples)}function _t(I){let T=i.get(I);return I.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&T.__useRenderToTexture!==!1}function Le(I){let T=o.render.frame;h.get(I)!==T&&(h.set(I,T),I.update())}function zt(I,T){let X=I.colorSpace,ot=I.format,nt=I.type;return I.isCompressedTexture===!0||I.isVideoTexture===!0||X!==to&&X!==Nn&&(Ht.getTransfer(X)===ne?(ot!==Oi||nt!==yi)&&Pt("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):kt("WebGLTextures: Unsupported texture color space:",X)),T}function Ut(I){return typeof HTMLImageElement<"u"&&I instanceof HTMLImageElement?(c.width=I.naturalWidth||I.width,c.height=I.naturalHeight||I.height):typeof VideoFrame<"u"&&I instanceof VideoFrame?(c.width=I.displayWidth,c.height=I.displayHeight):(c.width=I.width,c.height=I.height),c}this.allocateTextureUnit=ut,this.resetTextureUnits=$,this.getTextureUnits=Z,this.setTextureUnits=ct,this.setTexture2D=Q,this.setTexture2DArray=et,this.setTexture3D=rt,this.setTextureCube=at,this.rebindTextures=Pi,this.setupRenderTarget=Ii,this.updateRenderTargetMipmap=O,this.updateMultisampleRenderTarget=ge,this.setupDepthRenderbuffer=Ci,this.setupFrameBufferTexture=be,this.useMultisampledRTT=_t,this.dispose=V}function Wb(s,t){function e(i,n=Nn){let r,o=Ht.getTransfer(n);if(i===yi)return s.UNSIGNED_BYTE;if(i===hl)return s.UNSIGNED_SHORT_4_4_4_4;if(i===ul)return s.UNSIGNED_SHORT_5_5_5_1;if(i===lu)return s.UNSIGNED_INT_5_9_9_9_REV;if(i===cu)return s.UNSIGNED_INT_10F_11F_11F_REV;if(i===ou)return s.BYTE;if(i===au)return s.SHORT;if(i===Ar)return s.UNSIGNED_SHORT;if(i===cl)return s.INT;if(i===Zi)return s.UNSIGNED_INT;if(i===Fi)return s.FLOAT;if(i===Ji)return s.HALF_FLOAT;if(i===hu)return s.ALPHA;if(i===uu)return s.RGB;if(i===Oi)return s.RGBA;if(i===Tn)return s.DEPTH_COMPONENT;if(i===Ln)return s.DEPTH_STENCIL;if(i===du)return s.RED;if(i===dl)return s.RED_INTEGER;if(i===Kn)return s.RG;if(i===fl)return s.RG_INTEGER;if(i===pl)return s.RGBA_INTEGER;if(i===Eo||i===Ro||i===Co||i===Po)if(o===ne)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===Eo)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===Ro)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===Co)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===Po)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===Eo)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===Ro)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===Co)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===Po)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===ml||i===gl||i===xl||i===yl)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===ml)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===gl)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===xl)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===yl)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===_l||i===vl||i===bl||i===Sl||i===wl||i===Io||i===Ml)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(i===_l||i===vl)return o===ne?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===bl)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===Sl)return r.COMPRESSED_R11_EAC;if(i===wl)return r.COMPRESSED_SIGNED_R11_EAC;if(i===Io)return r.COMPRESSED_RG11_EAC;if(i===Ml)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===Tl||i===Al||i===El||i===Rl||i===Cl||i===Pl||i===Il||i===Ll||i===Nl||i===Dl||i===zl||i===kl||i===Fl||i===Ol)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(i===Tl)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===Al)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===El)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===Rl)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===Cl)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===Pl)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===Il)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===Ll)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Nl)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===Dl)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===zl)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===kl)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===Fl)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===Ol)return o===ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===Ul||i===Bl||i===Vl)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(i===Ul)return o===ne?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===Bl)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===Vl)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===Hl||i===Gl||i===Lo||i===Wl)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(i===Hl)return r.COMPRESSED_RED_RGTC1_EXT;if(i===Gl)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===Lo)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===Wl)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===Ns?s.UNSIGNED_INT_24_8:s[i]!==void 0?s[i]:null}return{convert:e}}var Xb=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,qb=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Nu=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let i=new ho(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=i}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,i=new an({vertexShader:Xb,fragmentShader:qb,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new st(new ws(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Du=class extends ji{constructor(t,e){super();let i=this,n=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,m=null,x=typeof XRWebGLBinding<"u",p=new Nu,g={},_=e.getContextAttributes(),b=null,y=null,M=[],S=[],v=new Rt,w=null,E=null,R=new Ce;R.viewport=new ae;let L=new Ce;L.viewport=new ae;let D=[R,L],U=new rl,N=null,V=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(G){let Q=M[G];return Q===void 0&&(Q=new pr,M[G]=Q),Q.getTargetRaySpace()},this.getControllerGrip=function(G){let Q=M[G];return Q===void 0&&(Q=new pr,M[G]=Q),Q.getGripSpace()},this.getHand=function(G){let Q=M[G];return Q===void 0&&(Q=new pr,M[G]=Q),Q.getHandSpace()};function k(G){let Q=S.indexOf(G.inputSource);if(Q===-1)return;let et=M[Q];et!==void 0&&(et.update(G.inputSource,G.frame,c||o),et.dispatchEvent({type:G.type,data:G.inputSource}))}function B(){n.removeEventListener("select",k),n.removeEventListener("selectstart",k),n.removeEventListener("selectend",k),n.removeEventListener("squeeze",k),n.removeEventListener("squeezestart",k),n.removeEventListener("squeezeend",k),n.removeEventListener("end",B),n.removeEventListener("inputsourceschange",Y);for(let G=0;G<M.length;G++){let Q=S[G];Q!==null&&(S[G]=null,M[G].disconnect(Q))}N=null,V=null,p.reset();for(let G in g)delete g[G];if(t.setRenderTarget(b),f=null,d=null,u=null,n=null,y=null,ut.stop(),i.isPresenting=!1,t.setPixelRatio(w),t.setSize(v.width,v.height,!1),E!==null){let G=E.camera;G.fov=E.fov,G.zoom=E.zoom,G.updateProjectionMatrix(),E=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(G){r=G,i.isPresenting===!0&&Pt("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(G){a=G,i.isPresenting===!0&&Pt("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(G){c=G},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&x&&(u=new XRWebGLBinding(n,e)),u},this.getFrame=function(){return m},this.getSession=function(){return n},this.setSession=async function(G){if(n=G,n!==null){if(b=t.getRenderTarget(),n.addEventListener("select",k),n.addEventListener("selectstart",k),n.addEventListener("selectend",k),n.addEventListener("squeeze",k),n.addEventListener("squeezestart",k),n.addEventListener("squeezeend",k),n.addEventListener("end",B),n.addEventListener("inputsourceschange",Y),_.xrCompatible!==!0&&await e.makeXRCompatible(),w=t.getPixelRatio(),t.getSize(v),x&&"createProjectionLayer"in XRWebGLBinding.prototype){let et=null,rt=null,at=null;_.depth&&(at=_.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,et=_.stencil?Ln:Tn,rt=_.stencil?Ns:Zi);let Lt={colorFormat:e.RGBA8,depthFormat:at,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Lt),n.updateRenderState({layers:[d]}),t.setPixelRatio(1),t.setSize(d.textureWidth,d.textureHeight,!1),y=new Ri(d.textureWidth,d.textureHeight,{format:Oi,type:yi,depthTexture:new Rn(d.textureWidth,d.textureHeight,rt,void 0,void 0,void 0,void 0,void 0,void 0,et),stencilBuffer:_.stencil,colorSpace:t.outputColorSpace,samples:_.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let et={antialias:_.antialias,alpha:!0,depth:_.depth,stencil:_.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(n,e,et),n.updateRenderState({baseLayer:f}),t.setPixelRatio(1),t.setSize(f.framebufferWidth,f.framebufferHeight,!1),y=new Ri(f.framebufferWidth,f.framebufferHeight,{format:Oi,type:yi,colorSpace:t.outputColorSpace,stencilBuffer:_.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}y.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await n.requestReferenceSpace(a),ut.setContext(n),ut.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(n!==null)return n.environmentBlendMode},this.getDepthTexture=function(){return p.getDepthTexture()};function Y(G){for(let Q=0;Q<G.removed.length;Q++){let et=G.removed[Q],rt=S.indexOf(et);rt>=0&&(S[rt]=null,M[rt].disconnect(et))}for(let Q=0;Q<G.added.length;Q++){let et=G.added[Q],rt=S.indexOf(et);if(rt===-1){for(let Lt=0;Lt<M.length;Lt++)if(Lt>=S.length){S.push(et),rt=Lt;break}else if(S[Lt]===null){S[Lt]=et,rt=Lt;break}if(rt===-1)break}let at=M[rt];at&&at.connect(et)}}function H(G,Q){Q===null?G.matrixWorld.copy(G.matrix):G.matrixWorld.multiplyMatrices(Q.matrixWorld,G.matrix),G.matrixWorldInverse.copy(G.matrixWorld).invert()}this.updateCamera=function(G){if(n===null)return;let Q=G.near,et=G.far;p.texture!==null&&(p.depthNear>0&&(Q=p.depthNear),p.depthFar>0&&(et=p.depthFar)),U.near=L.near=R.near=Q,U.far=L.far=R.far=et,(N!==U.near||V!==U.far)&&(n.updateRenderState({depthNear:U.near,depthFar:U.far}),N=U.near,V=U.far),U.layers.mask=G.layers.mask|6,R.layers.mask=U.layers.mask&-5,L.layers.mask=U.layers.mask&-3;let rt=G.parent,at=U.cameras;H(U,rt);for(let Lt=0;Lt<at.length;Lt++)H(at[Lt],rt);U.projectionMatrix.copy(R.projectionMatrix),U.projectionMatrixInverse.copy(R.projectionMatrixInverse),E===null&&G.isPerspectiveCamera&&(E={camera:G,fov:G.fov,zoom:G.zoom}),$(G,U,rt)};function $(G,Q,et){et===null?G.matrix.copy(Q.matrixWorld):(G.matrix.copy(et.matrixWorld),G.matrix.invert(),G.matrix.multiply(Q.matrixWorld)),G.matrix.decompose(G.position,G.quaternion,G.scale),G.updateMatrixWorld(!0),G.projectionMatrix.copy(Q.projectionMatrix),G.projectionMatrixInverse.copy(Q.projectionMatrixInverse),G.isPerspectiveCamera&&(G.fov=ys*2*Math.atan(1/G.projectionMatrix.elements[5]),G.zoom=1)}this.getCamera=function(){return U},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(G){l=G,d!==null&&(d.fixedFoveation=G),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=G)},this.hasDepthSensing=function(){return p.texture!==null},this.getDepthSensingMesh=function(){return p.getMesh(U)},this.getCameraTexture=function(G){return g[G]};let Z=null;function ct(G,Q){if(h=Q.getViewerPose(c||o),m=Q,h!==null){let et=h.views;f!==null&&(t.setRenderTargetFramebuffer(y,f.framebuffer),t.setRenderTarget(y));let rt=!1;et.length!==U.cameras.length&&(U.cameras.length=0,rt=!0);for(let Nt=0;Nt<et.length;Nt++){let se=et[Nt],he=null;if(f!==null)he=f.getViewport(se);else{let qe=u.getViewSubImage(d,se);he=qe.viewport,Nt===0&&(t.setRenderTargetTextures(y,qe.colorTexture,qe.depthStencilTexture),t.setRenderTarget(y))}let Yt=D[Nt];Yt===void 0&&(Yt=new Ce,Yt.layers.enable(Nt),Yt.viewport=new ae,D[Nt]=Yt),Yt.matrix.fromArray(se.transform.matrix),Yt.matrix.decompose(Yt.position,Yt.quaternion,Yt.scale),Yt.projectionMatrix.fromArray(se.projectionMatrix),Yt.projectionMatrixInverse.copy(Yt.projectionMatrix).invert(),Yt.viewport.set(he.x,he.y,he.width,he.height),Nt===0&&(U.matrix.copy(Yt.matrix),U.matrix.decompose(U.position,U.quaternion,U.scale)),rt===!0&&U.cameras.push(Yt)}let at=n.enabledFeatures;if(at&&at.includes("depth-sensing")&&n.depthUsage=="gpu-optimized"&&x){u=i.getBinding();let Nt=u.getDepthInformation(et[0]);Nt&&Nt.isValid&&Nt.texture&&p.init(Nt,n.renderState)}if(at&&at.includes("camera-access")&&x){t.state.unbindTexture(),u=i.getBinding();for(let Nt=0;Nt<et.length;Nt++){let se=et[Nt].camera;if(se){let he=g[se];he||(he=new ho,g[se]=he);let Yt=u.getCameraImage(se);he.sourceTexture=Yt}}}}for(let et=0;et<M.length;et++){let rt=S[et],at=M[et];rt!==null&&at!==void 0&&at.update(rt,Q,c||o)}Z&&Z(G,Q),Q.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:Q}),m=null}let ut=new zp;ut.setAnimationLoop(ct),this.setAnimationLoop=function(G){Z=G},this.dispose=function(){}}},jb=new wt,Xp=new Ot;Xp.set(-1,0,0,0,1,0,0,0,1);function Yb(s,t){function e(p,g){p.matrixAutoUpdate===!0&&p.updateMatrix(),g.value.copy(p.matrix)}function i(p,g){g.color.getRGB(p.fogColor.value,bu(s)),g.isFog?(p.fogNear.value=g.near,p.fogFar.value=g.far):g.isFogExp2&&(p.fogDensity.value=g.density)}function n(p,g,_,b,y){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(p,g):g.isMeshLambertMaterial?(r(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(p,g),u(p,g)):g.isMeshPhongMaterial?(r(p,g),h(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(p,g),d(p,g),g.isMeshPhysicalMaterial&&f(p,g,y)):g.isMeshMatcapMaterial?(r(p,g),m(p,g)):g.isMeshDepthMaterial?r(p,g):g.isMeshDistanceMaterial?(r(p,g),x(p,g)):g.isMeshNormalMaterial?r(p,g):g.isLineBasicMaterial?(o(p,g),g.isLineDashedMaterial&&a(p,g)):g.isPointsMaterial?l(p,g,_,b):g.isSpriteMaterial?c(p,g):g.isShadowMaterial?(p.color.value.copy(g.color),p.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(p,g){p.opacity.value=g.opacity,g.color&&p.diffuse.value.copy(g.color),g.emissive&&p.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.bumpMap&&(p.bumpMap.value=g.bumpMap,e(g.bumpMap,p.bumpMapTransform),p.bumpScale.value=g.bumpScale,g.side===ui&&(p.bumpScale.value*=-1)),g.normalMap&&(p.normalMap.value=g.normalMap,e(g.normalMap,p.normalMapTransform),p.normalScale.value.copy(g.normalScale),g.side===ui&&p.normalScale.value.negate()),g.displacementMap&&(p.displacementMap.value=g.displacementMap,e(g.displacementMap,p.displacementMapTransform),p.displacementScale.value=g.displacementScale,p.displacementBias.value=g.displacementBias),g.emissiveMap&&(p.emissiveMap.value=g.emissiveMap,e(g.emissiveMap,p.emissiveMapTransform)),g.specularMap&&(p.specularMap.value=g.specularMap,e(g.specularMap,p.specularMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest);let _=t.get(g),b=_.envMap,y=_.envMapRotation;b&&(p.envMap.value=b,p.envMapRotation.value.setFromMatrix4(jb.makeRotationFromEuler(y)).transpose(),b.isCubeTexture&&b.isRenderTargetTexture===!1&&p.envMapRotation.value.premultiply(Xp),p.reflectivity.value=g.reflectivity,p.ior.value=g.ior,p.refractionRatio.value=g.refractionRatio),g.lightMap&&(p.lightMap.value=g.lightMap,p.lightMapIntensity.value=g.lightMapIntensity,e(g.lightMap,p.lightMapTransform)),g.aoMap&&(p.aoMap.value=g.aoMap,p.aoMapIntensity.value=g.aoMapIntensity,e(g.aoMap,p.aoMapTransform))}function o(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform))}function a(p,g){p.dashSize.value=g.dashSize,p.totalSize.value=g.dashSize+g.gapSize,p.scale.value=g.scale}function l(p,g,_,b){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.size.value=g.size*_,p.scale.value=b*.5,g.map&&(p.map.value=g.map,e(g.map,p.uvTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function c(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.rotation.value=g.rotation,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function h(p,g){p.specular.value.copy(g.specular),p.shininess.value=Math.max(g.shininess,1e-4)}function u(p,g){g.gradientMap&&(p.gradientMap.value=g.gradientMap)}function d(p,g){p.metalness.value=g.metalness,g.metalnessMap&&(p.metalnessMap.value=g.metalnessMap,e(g.metalnessMap,p.metalnessMapTransform)),p.roughness.value=g.roughness,g.roughnessMap&&(p.roughnessMap.value=g.roughnessMap,e(g.roughnessMap,p.roughnessMapTransform)),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)}function f(p,g,_){p.ior.value=g.ior,g.diffuseRoughness>0&&(p.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(p.diffuseRoughnessMap.value=g.diffuseRoughnessMap,e(g.diffuseRoughnessMap,p.diffuseRoughnessMapTransform))),g.sheen>0&&(p.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),p.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(p.sheenColorMap.value=g.sheenColorMap,e(g.sheenColorMap,p.sheenColorMapTransform)),g.sheenRoughnessMap&&(p.sheenRoughnessMap.value=g.sheenRoughnessMap,e(g.sheenRoughnessMap,p.sheenRoughnessMapTransform))),g.clearcoat>0&&(p.clearcoat.value=g.clearcoat,p.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(p.clearcoatMap.value=g.clearcoatMap,e(g.clearcoatMap,p.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,e(g.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(p.clearcoatNormalMap.value=g.clearcoatNormalMap,e(g.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===ui&&p.clearcoatNormalScale.value.negate())),g.dispersion>0&&(p.dispersion.value=g.dispersion),g.retroreflectivity>0&&(p.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(p.iridescence.value=g.iridescence,p.iridescenceIOR.value=g.iridescenceIOR,p.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,p.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(p.iridescenceMap.value=g.iridescenceMap,e(g.iridescenceMap,p.iridescenceMapTransform)),g.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=g.iridescenceThicknessMap,e(g.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),g.transmission>0&&(p.transmission.value=g.transmission,p.transmissionSamplerMap.value=_.texture,p.transmissionSamplerSize.value.set(_.width,_.height),g.transmissionMap&&(p.transmissionMap.value=g.transmissionMap,e(g.transmissionMap,p.transmissionMapTransform)),p.thickness.value=g.thickness,g.thicknessMap&&(p.thicknessMap.value=g.thicknessMap,e(g.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=g.attenuationDistance,p.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(p.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(p.anisotropyMap.value=g.anisotropyMap,e(g.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=g.specularIntensity,p.specularColor.value.copy(g.specularColor),g.specularColorMap&&(p.specularColorMap.value=g.specularColorMap,e(g.specularColorMap,p.specularColorMapTransform)),g.specularIntensityMap&&(p.specularIntensityMap.value=g.specularIntensityMap,e(g.specularIntensityMap,p.specularIntensityMapTransform))}function m(p,g){g.matcap&&(p.matcap.value=g.matcap)}function x(p,g){let _=t.get(g).light;p.referencePosition.value.setFromMatrixPosition(_.matrixWorld),p.nearDistance.value=_.shadow.camera.near,p.farDistance.value=_.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:n}}function $b(s,t,e,i){let n={},r={};function o(_,b){let y=b.program;i.uniformBlockBinding(_,y,n[_.id])}function a(_,b){let y=n[_.id];y===void 0&&(m(_),y=l(_),n[_.id]=y,_.addEventListener("dispose",p));let M=b.program;i.updateUBOMapping(_,M);let S=t.render.frame;r[_.id]!==S&&(c(_),r[_.id]=S)}function l(_){let b=s.createBuffer(),y=_.__size,M=_.usage;return s.bindBuffer(s.UNIFORM_BUFFER,b),s.bufferData(s.UNIFORM_BUFFER,y,M),s.bindBuffer(s.UNIFORM_BUFFER,null),b}function c(_){let b=n[_.id],y=_.uniforms,M=_.__cache;s.bindBuffer(s.UNIFORM_BUFFER,b);for(let S=0,v=y.length;S<v;S++){let w=y[S];if(Array.isArray(w))for(let E=0,R=w.length;E<R;E++)h(w[E],S,E,M);else h(w,S,0,M)}s.bindBuffer(s.UNIFORM_BUFFER,null)}function h(_,b,y,M){if(d(_,b,y,M)===!0){let S=_.__offset,v=_.value;if(Array.isArray(v)){let w=0;for(let E=0;E<v.length;E++){let R=v[E],L=x(R,!0);u(R,_.__data,w),w+=L.storage/Float32Array.BYTES_PER_ELEMENT}}else u(v,_.__data,0);s.bufferSubData(s.UNIFORM_BUFFER,S,_.__data)}}function u(_,b,y){typeof _=="number"||typeof _=="boolean"?b[y]=_:_.isMatrix3?(b[y]=_.elements[0],b[y+1]=_.elements[1],b[y+2]=_.elements[2],b[y+3]=0,b[y+4]=_.elements[3],b[y+5]=_.elements[4],b[y+6]=_.elements[5],b[y+7]=0,b[y+8]=_.elements[6],b[y+9]=_.elements[7],b[y+10]=_.elements[8],b[y+11]=0):ArrayBuffer.isView(_)?b.set(_.subarray(0,b.length-y),y):_.toArray(b,y)}function d(_,b,y,M){let S=_.value,v=b+"_"+y;if(Array.isArray(S)){M[v]===void 0&&(M[v]=[]);let w=M[v],E=!1;for(let R=0;R<S.length;R++)f(S[R],w,R)===!0&&(E=!0);return E}return f(S,M,v)}function f(_,b,y){if(b[y]===void 0)return typeof _=="number"||typeof _=="boolean"?b[y]=_:ArrayBuffer.isView(_)?b[y]=_.slice():b[y]=_.clone(),!0;{let M=b[y];if(typeof _=="number"||typeof _=="boolean"){if(M!==_)return b[y]=_,!0}else{if(ArrayBuffer.isView(_))return!0;if(M.equals(_)===!1)return M.copy(_),!0}}return!1}function m(_){let b=_.uniforms,y=0,M=16;for(let v=0,w=b.length;v<w;v++){let E=Array.isArray(b[v])?b[v]:[b[v]];for(let R=0,L=E.length;R<L;R++){let D=E[R],U=Array.isArray(D.value)?D.value:[D.value],N=Array.isArray(b[v])||Array.isArray(D.value),V=y;for(let B=0,Y=U.length;B<Y;B++){let H=U[B],$=x(H,N),Z=y%M,ct=Z%$.boundary,ut=Z+ct;y+=ct,ut!==0&&M-ut<$.storage&&(y+=M-ut),B===0&&(V=y),y+=$.storage}let k=D.type==="int"?Int32Array:D.type==="uint"?Uint32Array:Float32Array;D.__data=new k((y-V)/Float32Array.BYTES_PER_ELEMENT),D.__offset=V}}let S=y%M;return S>0&&(y+=M-S),_.__size=y,_.__cache={},this}function x(_,b){let y={boundary:0,storage:0};return typeof _=="number"||typeof _=="boolean"?(y.boundary=4,y.storage=4):_.isVector2?(y.boundary=8,y.storage=8):_.isVector3||_.isColor?(y.boundary=16,y.storage=12):_.isVector4?(y.boundary=16,y.storage=16):_.isMatrix3?(y.boundary=16,y.storage=48):_.isMatrix4?(y.boundary=16,y.storage=64):_.isTexture?Pt("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(_)?(y.boundary=16,y.storage=_.byteLength):Pt("WebGLRenderer: Unsupported uniform value type.",_),b===!0&&(y.boundary=16,y.storage=Math.ceil(y.storage/16)*16),y}function p(_){let b=_.target;b.removeEventListener("dispose",p),s.deleteBuffer(n[b.id]),delete n[b.id],delete r[b.id]}function g(){for(let _ in n)s.deleteBuffer(n[_]);n={},r={}}return{bind:o,update:a,dispose:g}}var Zb=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),un=null;function Jb(){return un===null&&(un=new vs(Zb,16,16,Kn,Ji),un.name="DFG_LUT",un.minFilter=Ve,un.magFilter=Ve,un.wrapS=ci,un.wrapT=ci,un.generateMipmaps=!1,un.needsUpdate=!0),un}var $l=class{constructor(t={}){let{canvas:e=ep(),context:i=null,depth:n=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=yi}=t;this.isWebGLRenderer=!0;let m;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");m=i.getContextAttributes().alpha}else m=o;let x=f,p=new Set([pl,fl,dl]),g=new Set([yi,Zi,Ar,Ns,hl,ul]),_=new Uint32Array(4),b=new Int32Array(4),y={textures:[],min:[],max:[],resolution:[]},M=null,S=null,v=[],w=[],E=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=hn,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let R=this,L=!1,D=null,U=null,N=null,V=null;this._outputColorSpace=oe;let k=0,B=0,Y=null,H=-1,$=null,Z=new ae,ct=new ae,ut=null,G=new It(0),Q=0,et=e.width,rt=e.height,at=1,Lt=null,le=null,Nt=new ae(0,0,et,rt),se=new ae(0,0,et,rt),he=!1,Yt=new Wn,qe=new qa,Ie=!1,fi=!1,be=new wt,en=new C,Fe=new ae,Ci={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},Pi=!1;function Ii(){return Y===null?at:1}let O=i;function Li(A,F){return e.getContext(A,F)}let ge,xe,_t,Le,zt,Ut,I,T,X,ot,nt,dt,xt,K,tt,pt,z,it,J,mt,ht,ft,Ct;try{let A={alpha:!0,depth:n,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Dt,!1),e.addEventListener("webglcontextrestored",Gt,!1),e.addEventListener("webglcontextcreationerror",vt,!1),O===null){let F="webgl2";if(O=Li(F,A),O===null)throw Li(F)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Xt()}catch(A){throw e.removeEventListener("webglcontextlost",Dt,!1),e.removeEventListener("webglcontextrestored",Gt,!1),e.removeEventListener("webglcontextcreationerror",vt,!1),kt("WebGLRenderer: "+A.message),A}function Xt(){ge=new lv(O),ge.init(),ht=new Wb(O,ge),xe=new J_(O,ge,t,ht),_t=new Hb(O,ge),xe.reversedDepthBuffer&&d&&_t.buffers.depth.setReversed(!0),U=O.createFramebuffer(),N=O.createFramebuffer(),V=O.createFramebuffer(),Le=new uv(O),zt=new Rb,Ut=new Gb(O,ge,_t,zt,xe,ht,Le),I=new av(R),T=new fx(O),ft=new $_(O,T),X=new cv(O,T,Le,ft),ot=new fv(O,X,T,ft,Le),it=new dv(O,xe,Ut),tt=new K_(zt),nt=new Eb(R,I,ge,xe,ft,tt),dt=new Yb(R,zt),xt=new Pb,K=new kb(ge),z=new Y_(R,I,_t,ot,m,l),pt=new Vb(R,ot,xe),Ct=new $b(O,Le,xe,_t),J=new Z_(O,ge,Le),mt=new hv(O,ge,Le),Le.programs=nt.programs,R.capabilities=xe,R.extensions=ge,R.properties=zt,R.renderLists=xt,R.shadowMap=pt,R.state=_t,R.info=Le}x!==yi&&(E=new mv(x,e.width,e.height,a,n,r));let lt=new Du(R,O);this.xr=lt,this.getContext=function(){return O},this.getContextAttributes=function(){return O.getContextAttributes()},this.forceContextLoss=function(){let A=ge.get("WEBGL_lose_context");A&&A.loseContext()},this.forceContextRestore=function(){let A=ge.get("WEBGL_lose_context");A&&A.restoreContext()},this.getPixelRatio=function(){return at},this.setPixelRatio=function(A){A!==void 0&&(at=A,this.setSize(et,rt,!1))},this.getSize=function(A){return A.set(et,rt)},this.setSize=function(A,F,j=!0){if(lt.isPresenting){Pt("WebGLRenderer: Can't change size while VR device is presenting.");return}et=A,rt=F,e.width=Math.floor(A*at),e.height=Math.floor(F*at),j===!0&&(e.style.width=A+"px",e.style.height=F+"px"),E!==null&&E.setSize(e.width,e.height),this.setViewport(0,0,A,F)},this.getDrawingBufferSize=function(A){return A.set(et*at,rt*at).floor()},this.setDrawingBufferSize=function(A,F,j){et=A,rt=F,at=j,e.width=Math.floor(A*j),e.height=Math.floor(F*j),this.setViewport(0,0,A,F)},this.setEffects=function(A){if(x===yi){kt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(A){for(let F=0;F<A.length;F++)if(A[F].isOutputPass===!0){Pt("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}E.setEffects(A||[])},this.getCurrentViewport=function(A){return A.copy(Z)},this.getViewport=function(A){return A.copy(Nt)},this.setViewport=function(A,F,j,W){A.isVector4?Nt.set(A.x,A.y,A.z,A.w):Nt.set(A,F,j,W),_t.viewport(Z.copy(Nt).multiplyScalar(Ii()).round())},this.getScissor=function(A){return A.copy(se)},this.setScissor=function(A,F,j,W){A.isVector4?se.set(A.x,A.y,A.z,A.w):se.set(A,F,j,W),_t.scissor(ct.copy(se).multiplyScalar(Ii()).round())},this.getScissorTest=function(){return he},this.setScissorTest=function(A){_t.setScissorTest(he=A)},this.setOpaqueSort=function(A){Lt=A},this.setTransparentSort=function(A){le=A},this.getClearColor=function(A){return A.copy(z.getClearColor())},this.setClearColor=function(){z.setClearColor(...arguments)},this.getClearAlpha=function(){return z.getClearAlpha()},this.setClearAlpha=function(){z.setClearAlpha(...arguments)},this.clear=function(A=!0,F=!0,j=!0){let W=0;if(A){let q=!1;if(Y!==null){let yt=Y.texture.format;q=p.has(yt)}if(q){let yt=Y.texture.type,Mt=g.has(yt),gt=z.getClearColor(),St=z.getClearAlpha(),Et=gt.r,Bt=gt.g,$t=gt.b;Mt?(_[0]=Et,_[1]=Bt,_[2]=$t,_[3]=St,O.clearBufferuiv(O.COLOR,0,_)):(b[0]=Et,b[1]=Bt,b[2]=$t,b[3]=St,O.clearBufferiv(O.COLOR,0,b))}else W|=O.COLOR_BUFFER_BIT}F&&(W|=O.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),j&&(W|=O.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),W!==0&&O.clear(W)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(A){A.setRenderer(this),D=A},this.dispose=function(){e.removeEventListener("webglcontextlost",Dt,!1),e.removeEventListener("webglcontextrestored",Gt,!1),e.removeEventListener("webglcontextcreationerror",vt,!1),z.dispose(),xt.dispose(),K.dispose(),Ut.dispose(),zt.dispose(),I.dispose(),ot.dispose(),X.dispose(),ft.dispose(),Ct.dispose(),nt.dispose(),lt.dispose(),lt.removeEventListener("sessionstart",vd),lt.removeEventListener("sessionend",bd),hs.stop()};function Dt(A){A.preventDefault(),xu("WebGLRenderer: Context Lost."),L=!0}function Gt(){xu("WebGLRenderer: Context Restored."),L=!1;let A=Le.autoReset,F=pt.enabled,j=pt.autoUpdate,W=pt.needsUpdate,q=pt.type;Xt(),Le.autoReset=A,pt.enabled=F,pt.autoUpdate=j,pt.needsUpdate=W,pt.type=q}function vt(A){kt("WebGLRenderer: A WebGL context could not be created. Reason: ",A.statusMessage)}function re(A){let F=A.target;F.removeEventListener("dispose",re),Oe(F)}function Oe(A){kn(A),zt.remove(A)}function kn(A){let F=zt.get(A).programs;F!==void 0&&(F.forEach(function(j){nt.releaseProgram(j)}),A.isShaderMaterial&&nt.releaseShaderCache(A))}this.renderBufferDirect=function(A,F,j,W,q,yt){F===null&&(F=Ci);let Mt=q.isMesh&&q.matrixWorld.determinantAffine()<0,gt=Xg(A,F,j,W,q);_t.setMaterial(W,Mt);let St=j.index,Et=1;if(W.wireframe===!0){if(St=X.getWireframeAttribute(j),St===void 0)return;Et=2}let Bt=j.drawRange,$t=j.attributes.position,Tt=Bt.start*Et,Zt=(Bt.start+Bt.count)*Et;yt!==null&&(Tt=Math.max(Tt,yt.start*Et),Zt=Math.min(Zt,(yt.start+yt.count)*Et)),St!==null?(Tt=Math.max(Tt,0),Zt=Math.min(Zt,St.count)):$t!=null&&(Tt=Math.max(Tt,0),Zt=Math.min(Zt,$t.count));let Ee=Zt-Tt;if(Ee<0||Ee===1/0)return;ft.setup(q,W,gt,j,St);let fe,ue=J;if(St!==null&&(fe=T.get(St),ue=mt,ue.setIndex(fe)),q.isMesh)W.wireframe===!0?(_t.setLineWidth(W.wireframeLinewidth*Ii()),ue.setMode(O.LINES)):ue.setMode(O.TRIANGLES);else if(q.isLine){let $e=W.linewidth;$e===void 0&&($e=1),_t.setLineWidth($e*Ii()),q.isLineSegments?ue.setMode(O.LINES):q.isLineLoop?ue.setMode(O.LINE_LOOP):ue.setMode(O.LINE_STRIP)}else q.isPoints?ue.setMode(O.POINTS):q.isSprite&&ue.setMode(O.TRIANGLES);if(q.isBatchedMesh)if(ge.get("WEBGL_multi_draw"))ue.renderMultiDraw(q._multiDrawStarts,q._multiDrawCounts,q._multiDrawCount);else{let $e=q._multiDrawStarts,At=q._multiDrawCounts,li=q._multiDrawCount,Qt=St?T.get(St).bytesPerElement:1,us=zt.get(W).currentProgram.getUniforms();for(let Ze=0;Ze<li;Ze++)us.setValue(O,"_gl_DrawID",Ze),ue.render($e[Ze]/Qt,At[Ze])}else if(q.isInstancedMesh)ue.renderInstances(Tt,Ee,q.count);else if(j.isInstancedBufferGeometry){let $e=j._maxInstanceCount!==void 0?j._maxInstanceCount:1/0,At=Math.min(j.instanceCount,$e);ue.renderInstances(Tt,Ee,At)}else ue.render(Tt,Ee)};function _d(A,F,j,W){D!==null&&A.isNodeMaterial&&D.setObject(W,A),Ie===!0&&tt.setState(A,j,!1),A.transparent===!0&&A.side===si&&A.forceSinglePass===!1?(A.side=ui,A.needsUpdate=!0,Vr(A,F,W),A.side=cn,A.needsUpdate=!0,Vr(A,F,W),A.side=si):Vr(A,F,W)}this.compile=function(A,F,j=null){j===null&&(j=A),D!==null&&D.renderStart(A,F,j),S=K.get(j),S.init(F),w.push(S),j.traverseVisible(function(q){q.isLight&&q.layers.test(F.layers)&&(S.pushLight(q),q.castShadow&&S.pushShadow(q))}),A!==j&&A.traverseVisible(function(q){q.isLight&&q.layers.test(F.layers)&&(S.pushLight(q),q.castShadow&&S.pushShadow(q))}),S.setupLights(),D!==null&&D.updateLights(S.state.lightsArray),fi=this.localClippingEnabled,Ie=tt.init(this.clippingPlanes,fi),Ie===!0&&tt.setGlobalState(this.clippingPlanes,F),D!==null&&pt.render(S.state.shadowsArray,j,F);let W=new Set;return A.traverse(function(q){if(!(q.isMesh||q.isPoints||q.isLine||q.isSprite))return;let yt=q.material;if(yt)if(Array.isArray(yt))for(let Mt=0;Mt<yt.length;Mt++){let gt=yt[Mt];_d(gt,j,F,q),W.add(gt)}else _d(yt,j,F,q),W.add(yt)}),S=w.pop(),D!==null&&D.renderEnd(),W},this.compileAsync=function(A,F,j=null){let W=this.compile(A,F,j);return new Promise(q=>{function yt(){if(W.forEach(function(Mt){let St=zt.get(Mt).currentProgram;(St===void 0||St.isReady())&&W.delete(Mt)}),W.size===0){q(A);return}setTimeout(yt,10)}ge.get("KHR_parallel_shader_compile")!==null?yt():setTimeout(yt,10)})};let oh=null;function Gg(A){oh&&oh(A)}function vd(){hs.stop()}function bd(){hs.start()}let hs=new zp;hs.setAnimationLoop(Gg),typeof self<"u"&&hs.setContext(self),this.setAnimationLoop=function(A){oh=A,lt.setAnimationLoop(A),A===null?hs.stop():hs.start()},lt.addEventListener("sessionstart",vd),lt.addEventListener("sessionend",bd),this.render=function(A,F){if(F!==void 0&&F.isCamera!==!0){kt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(L===!0)return;D!==null&&D.renderStart(A,F);let j=lt.enabled===!0&&lt.isPresenting===!0,W=E!==null&&(Y===null||j)&&E.begin(R,Y);if(A.matrixWorldAutoUpdate===!0&&A.updateMatrixWorld(),F.parent===null&&F.matrixWorldAutoUpdate===!0&&F.updateMatrixWorld(),lt.enabled===!0&&lt.isPresenting===!0&&(E===null||E.isCompositing()===!1)&&(lt.cameraAutoUpdate===!0&&lt.updateCamera(F),F=lt.getCamera()),A.isScene===!0&&A.onBeforeRender(R,A,F,Y),S=K.get(A,w.length),S.init(F),S.state.textureUnits=Ut.getTextureUnits(),w.push(S),be.multiplyMatrices(F.projectionMatrix,F.matrixWorldInverse),F.isArrayCamera?qe.setFromArrayCamera(F):Yt.setFromProjectionMatrix(be,Di,F.reversedDepth),fi=this.localClippingEnabled,Ie=tt.init(this.clippingPlanes,fi),M=xt.get(A,v.length),M.init(),v.push(M),this.info.render.frame++,lt.enabled===!0&&lt.isPresenting===!0){let Mt=R.xr.getDepthSensingMesh();Mt!==null&&ah(Mt,F,-1/0,R.sortObjects)}ah(A,F,0,R.sortObjects),M.finish(),D!==null&&D.updateLights(S.state.lightsArray),R.sortObjects===!0&&M.sort(Lt,le),Pi=lt.enabled===!1||lt.isPresenting===!1||lt.hasDepthSensing()===!1,Pi&&z.addToRenderList(M,A),this.info.autoReset===!0&&this.info.reset(),Ie===!0&&tt.beginShadows();let q=S.state.shadowsArray;if(pt.render(q,A,F),Ie===!0&&tt.endShadows(),(W&&E.hasRenderPass())===!1){let Mt=M.opaque,gt=M.transmissive;if(S.setupLights(),F.isArrayCamera){let St=F.cameras;if(gt.length>0)for(let Et=0,Bt=St.length;Et<Bt;Et++){let $t=St[Et];wd(Mt,gt,A,$t)}Pi&&z.render(A);for(let Et=0,Bt=St.length;Et<Bt;Et++){let $t=St[Et];Sd(M,A,$t,$t.viewport)}}else gt.length>0&&wd(Mt,gt,A,F),Pi&&z.render(A),Sd(M,A,F)}Y!==null&&B===0&&(Ut.updateMultisampleRenderTarget(Y),Ut.updateRenderTargetMipmap(Y)),W&&E.end(R),A.isScene===!0&&A.onAfterRender(R,A,F),ft.resetDefaultState(),H=-1,$=null,w.pop(),w.length>0?(S=w[w.length-1],Ut.setTextureUnits(S.state.textureUnits),Ie===!0&&tt.setGlobalState(R.clippingPlanes,S.state.camera)):S=null,v.pop(),v.length>0?M=v[v.length-1]:M=null,D!==null&&D.renderEnd()};function ah(A,F,j,W){if(A.visible===!1)return;if(A.layers.test(F.layers)){if(A.isGroup)j=A.renderOrder;else if(A.isLOD)A.autoUpdate===!0&&A.update(F);else if(A.isLight)S.pushLight(A),A.castShadow&&S.pushShadow(A);else if(A.isSprite){let Mt=F.isArrayCamera?qe:Yt;if(!A.frustumCulled||A.intersectsFrustum(Mt)){W&&Fe.setFromMatrixPosition(A.matrixWorld).applyMatrix4(be);let gt=ot.update(A),St=A.material;St.visible&&M.push(A,gt,St,j,Fe.z,null,F)}}else if(A.isMesh||A.isLine||A.isPoints){let Mt=F.isArrayCamera?qe:Yt;if(!A.frustumCulled||A.intersectsFrustum(Mt)){let gt=ot.update(A),St=A.material;if(W&&(A.boundingSphere!==void 0?(A.boundingSphere===null&&A.computeBoundingSphere(),Fe.copy(A.boundingSphere.center)):(gt.boundingSphere===null&&gt.computeBoundingSphere(),Fe.copy(gt.boundingSphere.center)),Fe.applyMatrix4(A.matrixWorld).applyMatrix4(be)),Array.isArray(St)){let Et=gt.groups;for(let Bt=0,$t=Et.length;Bt<$t;Bt++){let Tt=Et[Bt],Zt=St[Tt.materialIndex];Zt&&Zt.visible&&M.push(A,gt,Zt,j,Fe.z,Tt,F)}}else St.visible&&M.push(A,gt,St,j,Fe.z,null,F)}}}let yt=A.children;for(let Mt=0,gt=yt.length;Mt<gt;Mt++)ah(yt[Mt],F,j,W)}function Sd(A,F,j,W){let{opaque:q,transmissive:yt,transparent:Mt}=A;S.setupLightsView(j),Ie===!0&&tt.setGlobalState(R.clippingPlanes,j),W&&_t.viewport(Z.copy(W)),q.length>0&&ia(q,F,j),yt.length>0&&ia(yt,F,j),Mt.length>0&&ia(Mt,F,j),_t.buffers.depth.setTest(!0),_t.buffers.depth.setMask(!0),_t.buffers.color.setMask(!0),_t.setPolygonOffset(!1)}function wd(A,F,j,W){if((j.isScene===!0?j.overrideMaterial:null)!==null)return;if(S.state.transmissionRenderTarget[W.id]===void 0){let Tt=ge.has("EXT_color_buffer_half_float")||ge.has("EXT_color_buffer_float");S.state.transmissionRenderTarget[W.id]=new Ri(1,1,{generateMipmaps:!0,type:Tt?Ji:yi,minFilter:ki,samples:Math.max(4,xe.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:Ht.workingColorSpace})}let yt=S.state.transmissionRenderTarget[W.id],Mt=W.viewport||Z;yt.setSize(Mt.z*R.transmissionResolutionScale,Mt.w*R.transmissionResolutionScale);let gt=R.getRenderTarget(),St=R.getActiveCubeFace(),Et=R.getActiveMipmapLevel();R.setRenderTarget(yt),R.getClearColor(G),Q=R.getClearAlpha(),Q<1&&R.setClearColor(16777215,.5),R.clear(),Pi&&z.render(j);let Bt=R.toneMapping;R.toneMapping=hn;let $t=W.viewport;if(W.viewport!==void 0&&(W.viewport=void 0),S.setupLightsView(W),Ie===!0&&tt.setGlobalState(R.clippingPlanes,W),ia(A,j,W),Ut.updateMultisampleRenderTarget(yt),Ut.updateRenderTargetMipmap(yt),ge.has("WEBGL_multisampled_render_to_texture")===!1){let Tt=!1;for(let Zt=0,Ee=F.length;Zt<Ee;Zt++){let fe=F[Zt],{object:ue,geometry:$e,material:At,group:li}=fe;if(At.side===si&&ue.layers.test(W.layers)){let Qt=At.side;At.side=ui,At.needsUpdate=!0,Md(ue,j,W,$e,At,li),At.side=Qt,At.needsUpdate=!0,Tt=!0}}Tt===!0&&(Ut.updateMultisampleRenderTarget(yt),Ut.updateRenderTargetMipmap(yt))}R.setRenderTarget(gt,St,Et),R.setClearColor(G,Q),$t!==void 0&&(W.viewport=$t),R.toneMapping=Bt}function ia(A,F,j){let W=F.isScene===!0?F.overrideMaterial:null;for(let q=0,yt=A.length;q<yt;q++){let Mt=A[q],{object:gt,geometry:St,group:Et}=Mt,Bt=Mt.material;Bt.allowOverride===!0&&W!==null&&(Bt=W),gt.layers.test(j.layers)&&Md(gt,F,j,St,Bt,Et)}}function Md(A,F,j,W,q,yt){D!==null&&q.isNodeMaterial&&D.setObject(A,q),A.onBeforeRender(R,F,j,W,q,yt),A.modelViewMatrix.multiplyMatrices(j.matrixWorldInverse,A.matrixWorld),A.normalMatrix.getNormalMatrix(A.modelViewMatrix),q.onBeforeRender(R,F,j,W,A,yt),q.transparent===!0&&q.side===si&&q.forceSinglePass===!1?(q.side=ui,q.needsUpdate=!0,R.renderBufferDirect(j,F,W,q,A,yt),q.side=cn,q.needsUpdate=!0,R.renderBufferDirect(j,F,W,q,A,yt),q.side=si):R.renderBufferDirect(j,F,W,q,A,yt),A.onAfterRender(R,F,j,W,q,yt)}function Td(A){let F=0;for(let j of A)j.texture!==null&&F++;return F}function Vr(A,F,j){F.isScene!==!0&&(F=Ci);let W=zt.get(A),q=S.state.lights,yt=S.state.shadowsArray,Mt=q.state.version,gt=nt.getParameters(A,q.state,yt,F,j,S.state.lightProbeGridArray),St=nt.getProgramCacheKey(gt),Et=W.programs;W.environment=A.isMeshStandardMaterial||A.isMeshLambertMaterial||A.isMeshPhongMaterial?F.environment:null,W.fog=F.fog;let Bt=A.isMeshStandardMaterial||A.isMeshLambertMaterial&&!A.envMap||A.isMeshPhongMaterial&&!A.envMap;W.envMap=I.get(A.envMap||W.environment,Bt),W.envMapRotation=W.environment!==null&&A.envMap===null?F.environmentRotation:A.envMapRotation,Et===void 0&&(A.addEventListener("dispose",re),Et=new Map,W.programs=Et,W.programVariants=new Map);let $t=Et.get(St);if($t!==void 0){if(W.currentProgram===$t&&W.lightsStateVersion===Mt)return Ed(A,gt),$t}else gt.uniforms=nt.getUniforms(A),D!==null&&A.isNodeMaterial&&D.build(A,j,gt),A.onBeforeCompile(gt,R),$t=nt.acquireProgram(gt,St),Et.set(St,$t),W.uniforms=gt.uniforms;let Tt=W.uniforms;return(!A.isShaderMaterial&&!A.isRawShaderMaterial||A.clipping===!0)&&(Tt.clippingPlanes=tt.uniform),Ed(A,gt),W.needsLights=jg(A),W.lightsStateVersion=Mt,W.needsLights&&(Tt.ambientLightColor.value=q.state.ambient,Tt.lightProbe.value=q.state.probe,Tt.sunLights.value=q.state.sun,Tt.sunLightShadows.value=q.state.sunShadow,Tt.directionalLights.value=q.state.directional,Tt.directionalLightShadows.value=q.state.directionalShadow,Tt.spotLights.value=q.state.spot,Tt.spotLightShadows.value=q.state.spotShadow,Tt.rectAreaLights.value=q.state.rectArea,Tt.ltc_1.value=q.state.rectAreaLTC1,Tt.ltc_2.value=q.state.rectAreaLTC2,Tt.pointLights.value=q.state.point,Tt.pointLightShadows.value=q.state.pointShadow,Tt.hemisphereLights.value=q.state.hemi,Tt.sunShadowMatrix.value=q.state.sunShadowMatrix,Tt.sunShadowCascade.value=q.state.sunShadowCascade,Tt.directionalShadowMatrix.value=q.state.directionalShadowMatrix,Tt.spotLightMatrix.value=q.state.spotLightMatrix,Tt.spotLightMap.value=q.state.spotLightMap,Tt.pointShadowMatrix.value=q.state.pointShadowMatrix),W.numLightProbeGrids=Td(S.state.lightProbeGridArray),W.currentProgram=$t,W.uniformsList=null,$t}function Wg(A,F,j,W,q){let yt=zt.get(A),Mt=yt.currentProgram.id+","+W+","+q,gt=yt.programVariants.get(Mt);return gt===void 0?(gt=Vr(A,F,j),yt.programVariants.set(Mt,gt)):(yt.currentProgram=gt,yt.uniformsList=null,yt.outputColorSpace=W,yt.toneMapping=q),gt}function Ad(A){if(A.uniformsList===null){let F=A.currentProgram.getUniforms();A.uniformsList=Er.seqWithValue(F.seq,A.uniforms)}return A.uniformsList}function Ed(A,F){let j=zt.get(A);j.outputColorSpace=F.outputColorSpace,j.batching=F.batching,j.batchingColor=F.batchingColor,j.instancing=F.instancing,j.instancingColor=F.instancingColor,j.instancingMorph=F.instancingMorph,j.skinning=F.skinning,j.morphTargets=F.morphTargets,j.morphNormals=F.morphNormals,j.morphColors=F.morphColors,j.morphTargetsCount=F.morphTargetsCount,j.numClippingPlanes=F.numClippingPlanes,j.numIntersection=F.numClipIntersection,j.vertexAlphas=F.vertexAlphas,j.vertexTangents=F.vertexTangents,j.toneMapping=F.toneMapping}function Xg(A,F,j,W,q){F.isScene!==!0&&(F=Ci),Ut.resetTextureUnits();let yt=F.fog,Mt=W.isMeshStandardMaterial||W.isMeshLambertMaterial||W.isMeshPhongMaterial?F.environment:null,gt=Y===null?R.outputColorSpace:Y.isXRRenderTarget===!0?Y.texture.colorSpace:Ht.workingColorSpace,St=W.isMeshStandardMaterial||W.isMeshLambertMaterial&&!W.envMap||W.isMeshPhongMaterial&&!W.envMap,Et=I.get(W.envMap||Mt,St),Bt=W.vertexColors===!0&&!!j.attributes.color&&j.attributes.color.itemSize===4,$t=!!j.attributes.tangent&&(!!W.normalMap||W.anisotropy>0),Tt=!!j.morphAttributes.position,Zt=!!j.morphAttributes.normal,Ee=!!j.morphAttributes.color,fe=hn;W.toneMapped&&(Y===null||Y.isXRRenderTarget===!0)&&(fe=R.toneMapping);let ue=j.morphAttributes.position||j.morphAttributes.normal||j.morphAttributes.color,$e=ue!==void 0?ue.length:0,At=zt.get(W),li=S.state.lights;if(Ie===!0&&(fi===!0||A!==$)){let Se=A===$&&W.id===H;tt.setState(W,A,Se)}let Qt=!1,us=!1;W.version===At.__version?At.needsLights&&At.lightsStateVersion!==li.state.version||q.isBatchedMesh&&At.batching===!1||!q.isBatchedMesh&&At.batching===!0||q.isBatchedMesh&&At.batchingColor===!0&&q._colorsTexture===null||q.isBatchedMesh&&At.batchingColor===!1&&q._colorsTexture!==null||q.isInstancedMesh&&At.instancing===!1||!q.isInstancedMesh&&At.instancing===!0||q.isSkinnedMesh&&At.skinning===!1||!q.isSkinnedMesh&&At.skinning===!0||q.isInstancedMesh&&At.instancingColor===!0&&q.instanceColor===null||q.isInstancedMesh&&At.instancingColor===!1&&q.instanceColor!==null||q.isInstancedMesh&&At.instancingMorph===!0&&q.morphTexture===null||q.isInstancedMesh&&At.instancingMorph===!1&&q.morphTexture!==null||At.envMap!==Et||W.fog===!0&&At.fog!==yt||At.numClippingPlanes!==void 0&&(At.numClippingPlanes!==tt.numPlanes||At.numIntersection!==tt.numIntersection)||At.vertexAlphas!==Bt||At.vertexTangents!==$t||At.morphTargets!==Tt||At.morphNormals!==Zt||At.morphColors!==Ee||At.morphTargetsCount!==$e||At.numLightProbeGrids!==Td(S.state.lightProbeGridArray)?Qt=!0:(At.outputColorSpace!==gt||At.toneMapping!==fe)&&(us=!0):(Qt=!0,At.__version=W.version);let Ze=At.currentProgram;(Qt===!0||us===!0)&&(Ze=us===!0?Wg(W,F,q,gt,fe):Vr(W,F,q),D&&W.isNodeMaterial&&D.onUpdateProgram(W,Ze,At));let na=!1,Fn=!1,ds=!1,Jt=Ze.getUniforms(),je=At.uniforms;if(_t.useProgram(Ze.program)&&(na=!0,Fn=!0,ds=!0),W.id!==H&&(H=W.id,Fn=!0),na||$!==A){_t.buffers.depth.getReversed()&&A.reversedDepth!==!0&&(A._reversedDepth=!0,A.updateProjectionMatrix()),Jt.setValue(O,"projectionMatrix",A.projectionMatrix),Jt.setValue(O,"viewMatrix",A.matrixWorldInverse);let Ue=Jt.map.cameraPosition;Ue!==void 0&&Ue.setValue(O,en.setFromMatrixPosition(A.matrixWorld)),xe.logarithmicDepthBuffer&&Jt.setValue(O,"logDepthBufFC",2/(Math.log(A.far+1)/Math.LN2)),(W.isMeshPhongMaterial||W.isMeshToonMaterial||W.isMeshLambertMaterial||W.isMeshBasicMaterial||W.isMeshStandardMaterial||W.isShaderMaterial)&&Jt.setValue(O,"isOrthographic",A.isOrthographicCamera===!0),$!==A&&($=A,Fn=!0,ds=!0)}if(At.needsLights&&(li.state.sunShadowMap.length>0&&Jt.setValue(O,"sunShadowMap",li.state.sunShadowMap,Ut),li.state.directionalShadowMap.length>0&&Jt.setValue(O,"directionalShadowMap",li.state.directionalShadowMap,Ut),li.state.spotShadowMap.length>0&&Jt.setValue(O,"spotShadowMap",li.state.spotShadowMap,Ut),li.state.pointShadowMap.length>0&&Jt.setValue(O,"pointShadowMap",li.state.pointShadowMap,Ut)),q.isSkinnedMesh){Jt.setOptional(O,q,"bindMatrix"),Jt.setOptional(O,q,"bindMatrixInverse");let Se=q.skeleton;Se&&(Se.boneTexture===null&&Se.computeBoneTexture(),Jt.setValue(O,"boneTexture",Se.boneTexture,Ut))}q.isBatchedMesh&&(Jt.setOptional(O,q,"batchingTexture"),Jt.setValue(O,"batchingTexture",q._matricesTexture,Ut),Jt.setOptional(O,q,"batchingIdTexture"),Jt.setValue(O,"batchingIdTexture",q._indirectTexture,Ut),Jt.setOptional(O,q,"batchingColorTexture"),q._colorsTexture!==null&&Jt.setValue(O,"batchingColorTexture",q._colorsTexture,Ut));let Gi=j.morphAttributes;if((Gi.position!==void 0||Gi.normal!==void 0||Gi.color!==void 0)&&it.update(q,j,Ze),(Fn||At.receiveShadow!==q.receiveShadow)&&(At.receiveShadow=q.receiveShadow,Jt.setValue(O,"receiveShadow",q.receiveShadow)),(W.isMeshStandardMaterial||W.isMeshLambertMaterial||W.isMeshPhongMaterial)&&W.envMap===null&&F.environment!==null&&(je.envMapIntensity.value=F.environmentIntensity),je.dfgLUT!==void 0&&(je.dfgLUT.value=Jb()),Fn){if(Jt.setValue(O,"toneMappingExposure",R.toneMappingExposure),At.needsLights&&qg(je,ds),yt&&W.fog===!0&&dt.refreshFogUniforms(je,yt),dt.refreshMaterialUniforms(je,W,at,rt,S.state.transmissionRenderTarget[A.id]),At.needsLights&&At.numLightProbeGrids>0){let Se=y,Ue=0;for(let gn of S.state.lightProbeGridArray)gn.texture!==null&&(Se.textures[Ue]=gn.texture,Se.min[Ue]=gn.boundingBox.min,Se.max[Ue]=gn.boundingBox.max,Se.resolution[Ue]=gn.resolution,Ue++);for(let gn in Se)Se[gn].length=Ue;je.probesSH.value=Se.textures,je.probesMin.value=Se.min,je.probesMax.value=Se.max,je.probesResolution.value=Se.resolution}Er.upload(O,Ad(At),je,Ut)}if(W.isShaderMaterial&&W.uniformsNeedUpdate===!0&&(Er.upload(O,Ad(At),je,Ut),W.uniformsNeedUpdate=!1),W.isSpriteMaterial&&Jt.setValue(O,"center",q.center),Jt.setValue(O,"modelViewMatrix",q.modelViewMatrix),Jt.setValue(O,"normalMatrix",q.normalMatrix),Jt.setValue(O,"modelMatrix",q.matrixWorld),W.uniformsGroups!==void 0){let Se=W.uniformsGroups;for(let Ue=0,gn=Se.length;Ue<gn;Ue++){let Cd=Se[Ue];Ct.update(Cd,Ze),Ct.bind(Cd,Ze)}}return Ze}function qg(A,F){A.ambientLightColor.needsUpdate=F,A.lightProbe.needsUpdate=F,A.sunLights.needsUpdate=F,A.sunLightShadows.needsUpdate=F,A.directionalLights.needsUpdate=F,A.directionalLightShadows.needsUpdate=F,A.pointLights.needsUpdate=F,A.pointLightShadows.needsUpdate=F,A.spotLights.needsUpdate=F,A.spotLightShadows.needsUpdate=F,A.rectAreaLights.needsUpdate=F,A.hemisphereLights.needsUpdate=F}function jg(A){return A.isMeshLambertMaterial||A.isMeshToonMaterial||A.isMeshPhongMaterial||A.isMeshStandardMaterial||A.isShadowMaterial||A.isShaderMaterial&&A.lights===!0}this.getActiveCubeFace=function(){return k},this.getActiveMipmapLevel=function(){return B},this.getRenderTarget=function(){return Y},this.setRenderTargetTextures=function(A,F,j){let W=zt.get(A);W.__autoAllocateDepthBuffer=A.resolveDepthBuffer===!1,W.__autoAllocateDepthBuffer===!1&&(W.__useRenderToTexture=!1),zt.get(A.texture).__webglTexture=F,zt.get(A.depthTexture).__webglTexture=W.__autoAllocateDepthBuffer?void 0:j,W.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(A,F){let j=zt.get(A);j.__webglFramebuffer=F,j.__useDefaultFramebuffer=F===void 0},this.setRenderTarget=function(A,F=0,j=0){Y=A,k=F,B=j;let W=null,q=!1,yt=!1;if(A){let gt=zt.get(A);if(gt.__useDefaultFramebuffer!==void 0){_t.bindFramebuffer(O.FRAMEBUFFER,gt.__webglFramebuffer),Z.copy(A.viewport),ct.copy(A.scissor),ut=A.scissorTest,_t.viewport(Z),_t.scissor(ct),_t.setScissorTest(ut),H=-1;return}else if(gt.__webglFramebuffer===void 0)Ut.setupRenderTarget(A);else if(gt.__hasExternalTextures)Ut.rebindTextures(A,zt.get(A.texture).__webglTexture,zt.get(A.depthTexture).__webglTexture);else if(A.depthBuffer){let Bt=A.depthTexture;if(gt.__boundDepthTexture!==Bt){if(Bt!==null&&zt.has(Bt)&&(A.width!==Bt.image.width||A.height!==Bt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ut.setupDepthRenderbuffer(A)}}let St=A.texture;(St.isData3DTexture||St.isDataArrayTexture||St.isCompressedArrayTexture)&&(yt=!0);let Et=zt.get(A).__webglFramebuffer;A.isWebGLCubeRenderTarget?(Array.isArray(Et[F])?W=Et[F][j]:W=Et[F],q=!0):A.samples>0&&Ut.useMultisampledRTT(A)===!1?W=zt.get(A).__webglMultisampledFramebuffer:Array.isArray(Et)?W=Et[j]:W=Et,Z.copy(A.viewport),ct.copy(A.scissor),ut=A.scissorTest}else Z.copy(Nt).multiplyScalar(at).floor(),ct.copy(se).multiplyScalar(at).floor(),ut=he;if(j!==0&&(W=U),_t.bindFramebuffer(O.FRAMEBUFFER,W)&&_t.drawBuffers(A,W),_t.viewport(Z),_t.scissor(ct),_t.setScissorTest(ut),q){let gt=zt.get(A.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_CUBE_MAP_POSITIVE_X+F,gt.__webglTexture,j)}else if(yt){let gt=F;for(let St=0;St<A.textures.length;St++){let Et=zt.get(A.textures[St]);O.framebufferTextureLayer(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0+St,Et.__webglTexture,j,gt)}}else if(A!==null&&j!==0){let gt=zt.get(A.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,gt.__webglTexture,j)}H=-1};function Rd(A){let F=zt.get(A);return(F.__readFormat!==A.format||F.__readType!==A.type)&&(F.__readFormat=A.format,F.__readType=A.type,F.__formatReadable=xe.textureFormatReadable(A.format),F.__typeReadable=xe.textureTypeReadable(A.type)),F}this.readRenderTargetPixels=function(A,F,j,W,q,yt,Mt,gt=0){if(!(A&&A.isWebGLRenderTarget)){kt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let St=zt.get(A).__webglFramebuffer;if(A.isWebGLCubeRenderTarget&&Mt!==void 0&&(St=St[Mt],Array.isArray(St)&&(St=St[0])),St){_t.bindFramebuffer(O.FRAMEBUFFER,St);try{let Et=A.textures[gt],Bt=Et.format,$t=Et.type;A.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+gt);let Tt=Rd(Et);if(Tt.__formatReadable===!1){kt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Tt.__typeReadable===!1){kt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}F>=0&&F<=A.width-W&&j>=0&&j<=A.height-q&&O.readPixels(F,j,W,q,ht.convert(Bt),ht.convert($t),yt)}finally{let Et=Y!==null?zt.get(Y).__webglFramebuffer:null;_t.bindFramebuffer(O.FRAMEBUFFER,Et)}}},this.readRenderTargetPixelsAsync=async function(A,F,j,W,q,yt,Mt,gt=0){if(!(A&&A.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let St=zt.get(A).__webglFramebuffer;if(A.isWebGLCubeRenderTarget&&Mt!==void 0&&(St=St[Mt],Array.isArray(St)&&(St=St[0])),St)if(F>=0&&F<=A.width-W&&j>=0&&j<=A.height-q){_t.bindFramebuffer(O.FRAMEBUFFER,St);let Et=A.textures[gt],Bt=Et.format,$t=Et.type;A.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+gt);let Tt=Rd(Et);if(Tt.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Tt.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let Zt=O.createBuffer();O.bindBuffer(O.PIXEL_PACK_BUFFER,Zt),O.bufferData(O.PIXEL_PACK_BUFFER,yt.byteLength,O.STREAM_READ),O.readPixels(F,j,W,q,ht.convert(Bt),ht.convert($t),0),O.bindBuffer(O.PIXEL_PACK_BUFFER,null);let Ee=Y!==null?zt.get(Y).__webglFramebuffer:null;_t.bindFramebuffer(O.FRAMEBUFFER,Ee);let fe=O.fenceSync(O.SYNC_GPU_COMMANDS_COMPLETE,0);return O.flush(),await np(O,fe,4),O.bindBuffer(O.PIXEL_PACK_BUFFER,Zt),O.getBufferSubData(O.PIXEL_PACK_BUFFER,0,yt),O.bindBuffer(O.PIXEL_PACK_BUFFER,null),O.deleteBuffer(Zt),O.deleteSync(fe),yt}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(A,F=null,j=0){let W=Math.pow(2,-j),q=Math.floor(A.image.width*W),yt=Math.floor(A.image.height*W),Mt=F!==null?F.x:0,gt=F!==null?F.y:0;Ut.setTexture2D(A,0),O.copyTexSubImage2D(O.TEXTURE_2D,j,0,0,Mt,gt,q,yt),_t.unbindTexture()},this.copyTextureToTexture=function(A,F,j=null,W=null,q=0,yt=0){let Mt,gt,St,Et,Bt,$t,Tt,Zt,Ee,fe=A.isCompressedTexture?A.mipmaps[yt]:A.image;if(j!==null)Mt=j.max.x-j.min.x,gt=j.max.y-j.min.y,St=j.isBox3?j.max.z-j.min.z:1,Et=j.min.x,Bt=j.min.y,$t=j.isBox3?j.min.z:0;else{let Jt=Math.pow(2,-q);Mt=Math.floor(fe.width*Jt),gt=Math.floor(fe.height*Jt),A.isDataArrayTexture?St=fe.depth:A.isData3DTexture?St=Math.floor(fe.depth*Jt):St=1,Et=0,Bt=0,$t=0}W!==null?(Tt=W.x,Zt=W.y,Ee=W.z):(Tt=0,Zt=0,Ee=0);let ue=ht.convert(F.format),$e=ht.convert(F.type),At;F.isData3DTexture?(Ut.setTexture3D(F,0),At=O.TEXTURE_3D):F.isDataArrayTexture||F.isCompressedArrayTexture?(Ut.setTexture2DArray(F,0),At=O.TEXTURE_2D_ARRAY):(Ut.setTexture2D(F,0),At=O.TEXTURE_2D),_t.activeTexture(O.TEXTURE0),_t.pixelStorei(O.UNPACK_FLIP_Y_WEBGL,F.flipY),_t.pixelStorei(O.UNPACK_PREMULTIPLY_ALPHA_WEBGL,F.premultiplyAlpha),_t.pixelStorei(O.UNPACK_ALIGNMENT,F.unpackAlignment);let li=_t.getParameter(O.UNPACK_ROW_LENGTH),Qt=_t.getParameter(O.UNPACK_IMAGE_HEIGHT),us=_t.getParameter(O.UNPACK_SKIP_PIXELS),Ze=_t.getParameter(O.UNPACK_SKIP_ROWS),na=_t.getParameter(O.UNPACK_SKIP_IMAGES);_t.pixelStorei(O.UNPACK_ROW_LENGTH,fe.width),_t.pixelStorei(O.UNPACK_IMAGE_HEIGHT,fe.height),_t.pixelStorei(O.UNPACK_SKIP_PIXELS,Et),_t.pixelStorei(O.UNPACK_SKIP_ROWS,Bt),_t.pixelStorei(O.UNPACK_SKIP_IMAGES,$t);let Fn=A.isDataArrayTexture||A.isData3DTexture,ds=F.isDataArrayTexture||F.isData3DTexture;if(A.isDepthTexture){let Jt=zt.get(A),je=zt.get(F),Gi=zt.get(Jt.__renderTarget),Se=zt.get(je.__renderTarget);_t.bindFramebuffer(O.READ_FRAMEBUFFER,Gi.__webglFramebuffer),_t.bindFramebuffer(O.DRAW_FRAMEBUFFER,Se.__webglFramebuffer);for(let Ue=0;Ue<St;Ue++)Fn&&(O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,zt.get(A).__webglTexture,q,$t+Ue),O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,zt.get(F).__webglTexture,yt,Ee+Ue)),O.blitFramebuffer(Et,Bt,Et+Mt,Bt+gt,Tt,Zt,Tt+Mt,Zt+gt,O.DEPTH_BUFFER_BIT,O.NEAREST);_t.bindFramebuffer(O.READ_FRAMEBUFFER,null),_t.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else if(q!==0||A.isRenderTargetTexture||zt.has(A)){let Jt=zt.get(A),je=zt.get(F);_t.bindFramebuffer(O.READ_FRAMEBUFFER,N),_t.bindFramebuffer(O.DRAW_FRAMEBUFFER,V);for(let Gi=0;Gi<St;Gi++)Fn?O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Jt.__webglTexture,q,$t+Gi):O.framebufferTexture2D(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,Jt.__webglTexture,q),ds?O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,je.__webglTexture,yt,Ee+Gi):O.framebufferTexture2D(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,je.__webglTexture,yt),q!==0?O.blitFramebuffer(Et,Bt,Et+Mt,Bt+gt,Tt,Zt,Tt+Mt,Zt+gt,O.COLOR_BUFFER_BIT,O.NEAREST):ds?O.copyTexSubImage3D(At,yt,Tt,Zt,Ee+Gi,Et,Bt,Mt,gt):O.copyTexSubImage2D(At,yt,Tt,Zt,Et,Bt,Mt,gt);_t.bindFramebuffer(O.READ_FRAMEBUFFER,null),_t.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else ds?A.isDataTexture||A.isData3DTexture?O.texSubImage3D(At,yt,Tt,Zt,Ee,Mt,gt,St,ue,$e,fe.data):F.isCompressedArrayTexture?O.compressedTexSubImage3D(At,yt,Tt,Zt,Ee,Mt,gt,St,ue,fe.data):O.texSubImage3D(At,yt,Tt,Zt,Ee,Mt,gt,St,ue,$e,fe):A.isDataTexture?O.texSubImage2D(O.TEXTURE_2D,yt,Tt,Zt,Mt,gt,ue,$e,fe.data):A.isCompressedTexture?O.compressedTexSubImage2D(O.TEXTURE_2D,yt,Tt,Zt,fe.width,fe.height,ue,fe.data):O.texSubImage2D(O.TEXTURE_2D,yt,Tt,Zt,Mt,gt,ue,$e,fe);_t.pixelStorei(O.UNPACK_ROW_LENGTH,li),_t.pixelStorei(O.UNPACK_IMAGE_HEIGHT,Qt),_t.pixelStorei(O.UNPACK_SKIP_PIXELS,us),_t.pixelStorei(O.UNPACK_SKIP_ROWS,Ze),_t.pixelStorei(O.UNPACK_SKIP_IMAGES,na),yt===0&&F.generateMipmaps===!0&&F.mipmapsAutoUpdate===!0&&O.generateMipmap(At),_t.unbindTexture()},this.initRenderTarget=function(A){zt.get(A).__webglFramebuffer===void 0&&Ut.setupRenderTarget(A)},this.initTexture=function(A){A.isCubeTexture?Ut.setTextureCube(A,0):A.isData3DTexture?Ut.setTexture3D(A,0):A.isDataArrayTexture||A.isCompressedArrayTexture?Ut.setTexture2DArray(A,0):Ut.setTexture2D(A,0),_t.unbindTexture()},this.resetState=function(){k=0,B=0,Y=null,_t.reset(),ft.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Di}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=Ht._getDrawingBufferColorSpace(t),e.unpackColorSpace=Ht._getUnpackColorSpace()}};var Pr=[{format:"quaternion_xyzw",title:"Quaternion xyzw"},{format:"quaternion_wxyz",title:"Quaternion wxyz"},{format:"rpy",title:"Roll pitch yaw"},{format:"zyz",title:"Euler ZYZ"},{format:"rotation_vector",title:"Rotation vector"},{format:"rotation",title:"Rotation matrix"},{format:"matrix",title:"Homogeneous"}],Kl=new Set(["rpy","zyz","rotation_vector"]);function zs(s){let t=s.elements;return[0,1,2,3].map(e=>[0,1,2,3].map(i=>t[e+4*i]))}function ks(s){return[...s.elements.slice(12,15)]}function di(s,t){return t==="matrix"?{matrix:zs(s)}:{position:ks(s),[t]:Qb(s,t)}}function Qb(s,t){let e=zs(s).slice(0,3).map(n=>n.slice(0,3)),i=(n,r)=>e[n][r];switch(t){case"rotation":return e;case"quaternion_xyzw":return zu(s);case"quaternion_wxyz":{let[n,r,o,a]=zu(s);return[a,n,r,o]}case"rotation_vector":{let[n,r,o,a]=zu(s),l=Math.hypot(n,r,o),c=l>0?2*Math.atan2(l,a)/l:2;return[n*c,r*c,o*c]}case"rpy":{let n=Math.hypot(i(0,0),i(1,0)),r=Math.atan2(-i(2,0),n);return n<1e-9?[0,r,Math.atan2(-i(0,1),i(1,1))]:[Math.atan2(i(2,1),i(2,2)),r,Math.atan2(i(1,0),i(0,0))]}case"zyz":{let n=Math.hypot(i(0,2),i(1,2)),r=Math.atan2(n,i(2,2));return n<1e-9?[Math.atan2(i(1,0),i(1,1)),r,0]:[Math.atan2(i(1,2),i(0,2)),r,Math.atan2(i(2,1),-i(2,0))]}}}function zu(s){let t=new Wt().setFromRotationMatrix(s).normalize(),e=t.w<0?-1:1;return[t.x*e,t.y*e,t.z*e,t.w*e]}function Pe(s){let t=new wt;if(!s)return t;if(s.matrix)return t.set(...s.matrix.flat());let[e=0,i=0,n=0]=s.position??[];if(s.rotation){let[r,o,a]=s.rotation;return t.set(...r,e,...o,i,...a,n,0,0,0,1)}return t.makeRotationFromQuaternion(tS(s)),t.setPosition(e,i,n)}function tS(s){if(s.quaternion_xyzw)return new Wt(...s.quaternion_xyzw).normalize();if(s.quaternion_wxyz){let[n,r,o,a]=s.quaternion_wxyz;return new Wt(r,o,a,n).normalize()}if(s.rotation_vector){let[n=0,r=0,o=0]=s.rotation_vector,a=Math.hypot(n,r,o),l=a>0?Math.sin(a/2)/a:.5;return new Wt(n*l,r*l,o*l,Math.cos(a/2))}let[t=0,e=0,i=0]=s.zyz??s.rpy??[];return s.zyz?Cr("z",t).multiply(Cr("y",e)).multiply(Cr("z",i)):Cr("z",i).multiply(Cr("y",e)).multiply(Cr("x",t))}function Cr(s,t){let e=new Wt(0,0,0,Math.cos(t/2));return e[s]=Math.sin(t/2),e}function qp(s,t){let e=s.elements,i=t.elements,n=o=>e[o]-i[o],r=Math.hypot(...[0,1,2,4,5,6,8,9,10].map(n));return{position:Math.hypot(n(12),n(13),n(14)),angle:2*Math.asin(Math.min(1,r/Math.SQRT2/2))}}function jp(s){if(typeof s!="object"||s===null)return!1;let{position:t,...e}=s,i=Oo(e);return Object.keys(e).length!==1||!i||i==="matrix"!=(t===void 0)?!1:(t===void 0||ku(t,[3]))&&ku(e[i],eS[i])}function Oo(s){return Pr.find(({format:t})=>s[t]!==void 0)?.format??null}var eS={quaternion_xyzw:[4],quaternion_wxyz:[4],rpy:[3],zyz:[3],rotation_vector:[3],rotation:[3,3],matrix:[4,4]};function ku(s,[t,...e]){return t===void 0?Number.isFinite(s):Array.isArray(s)&&s.length===t&&s.every(i=>ku(i,e))}function Yp(s){let t=Pe(s),[e,i,n,r]=[new C,new C,new C,new C().setFromMatrixPosition(t)];return t.extractBasis(e,i,n),n.crossVectors(e,i).normalize(),e.normalize(),i.crossVectors(n,e),(n.length()<.5?new wt:new wt().makeBasis(e,i,n)).setPosition(r)}var ts=["x","y","z","rx","ry","rz"];var Ou=["degrees","frames","axes","names","dh"],iS=/^[a-z]+\.[a-z]+$/,nS=["transforms","pose","jacobian","singular","motion"],sS=250;function Uu(s){let t=new URLSearchParams(s.replace(/^#/,"")),e={...qs};e.panel=t.get("panel")??qs.panel,e.draft=Fu(t.get("dh-table")),e.robot=e.draft?"":t.get("robot")??qs.robot,e.base=t.get("base"),e.tip=t.get("tip");let i=Fu(t.get("target"));e.target=jp(i)?i:null,e.inverse=oS(Fu(t.get("ik"))),e.writing=aS(t.get("worked")?.split(",")??[]);let n=new Set((t.get("show")??"").split(","));for(let o of Ou)e[o]=n.has(o);e.options=Object.fromEntries([...t].filter(([o])=>iS.test(o)));let r=t.get("q")?.split(",").map(Number)??null;return{linked:e,positions:r?.every(Number.isFinite)?r:null}}function rS(s){let t=[];s.draft?t.push(["dh-table",JSON.stringify(s.draft)]):t.push(["robot",s.robot]),t.push(["panel",s.panel]),s.base&&t.push(["base",s.base]),s.tip&&t.push(["tip",s.tip]),s.model&&t.push(["q",s.model.joints.map(n=>s.positions[n.name]??0).join(",")]),s.target&&t.push(["target",JSON.stringify(s.target)]),s.inverse&&t.push(["ik",JSON.stringify(s.inverse)]);let e=$p(s.writing);e!==$p(qs.writing)&&t.push(["worked",e]);let i=Ou.filter(n=>s[n]);return i.length&&t.push(["show",i.join(",")]),t.push(...Object.entries(s.options).sort()),"#"+t.map(([n,r])=>`${n}=${encodeURIComponent(r).replaceAll("%2C",",")}`).join("&")}function Zp(s,t){let e=0,i=location.hash,n=Ql(s.value),r=()=>{let{model:a,robot:l,draft:c,loading:h}=s.value;if(h||!a||a.name!==(c?null:l))return;let u=rS(s.value);if(u===i)return;let d=Ql(s.value)!==n;n=Ql(s.value),i=u,d?history.pushState(null,"",u):history.replaceState(null,"",u)};s.watch(["panel","robot","draft","base","tip","target","inverse","writing","positions","model","loading","options",...Ou],()=>{clearTimeout(e),e=window.setTimeout(r,sS)});let o=()=>{location.hash!==i&&(clearTimeout(e),i=location.hash,t(Uu(location.hash)),n=Ql(s.value))};window.addEventListener("popstate",o),window.addEventListener("hashchange",o)}function Ql(s){return`${s.panel} ${s.robot}`}function oS(s){if(typeof s!="object"||s===null)return null;let{task:t,...e}=s,i=Array.isArray(t)?ts.filter(n=>t.includes(n)):[];return i.length?{...e,task:i}:e}function $p({part:s,notation:t,symbolic:e}){return[s,t==="full"&&"full",!e&&"values"].filter(Boolean).join(",")}function aS(s){return{part:s.find(e=>nS.includes(e))??qs.writing.part,notation:s.includes("full")?"full":"short",symbolic:!s.includes("values")}}function Fu(s){try{return s===null?null:JSON.parse(s)}catch{return null}}var We=class extends Error{constructor(e,i,n,r={}){super(n);this.status=e;this.title=i;this.detail=n;this.facts=r}status;title;detail;facts;get places(){let{errors:e,pointer:i}=this.facts;return e||(i?[{pointer:i,detail:this.detail}]:[])}},Bu=0,Jp=-1,tc=class s{constructor(t,e=()=>{}){this.root=t;this.record=e}root;record;recorded(t){return new s(this.root,t)}url(t){return new URL(t,this.root).href}get(t,e){return this.call({method:"GET",path:t},e)}post(t,e,i){return this.call({method:"POST",path:t,body:e},i)}async text(t,e){return(await this.answer({method:"GET",path:t},e)).text()}async call(t,e){let i=await this.answer(t,e);return i.status===204?null:await i.json()}async answer(t,e){this.record(t);let i;try{i=await fetch(this.url(t.path),{method:t.method,...lS(t),signal:e??null})}catch(n){throw e?.aborted?n:new We(Bu,"No answer","The service does not answer. Is it still running?")}if(!i.ok)throw await cS(i);return i}};function lS(s){if(s.form){let t=new FormData;for(let[e,i]of Object.entries(s.form.fields))t.set(e,i);return t.set("archive",s.form.archive),{body:t}}return s.body===void 0?{}:{body:JSON.stringify(s.body),headers:{"Content-Type":"application/json"}}}async function cS(s){let t=`The service answered ${s.status} ${s.statusText}.`;if(!s.headers.get("Content-Type")?.includes("json"))return new We(s.status,"Error",t);let{title:e,detail:i,...n}=await s.json();return new We(s.status,String(e??"Error"),String(i??t),n)}var Ye=class{#t=null;async run(t){this.#t?.abort();let e=new AbortController;this.#t=e;try{let i=await t(e.signal);return e.signal.aborted?void 0:i}catch(i){if(e.signal.aborted)return;throw i}}cancel(){this.#t?.abort()}};var Ir=class extends ni{constructor(t){super(t)}load(t,e,i,n){let r=this,o=new zi(this.manager);o.setPriority(this.priority),o.setCache(this.cache),o.setPath(this.path),o.setResponseType("arraybuffer"),o.setRequestHeader(this.requestHeader),o.setWithCredentials(this.withCredentials),o.load(t,function(a){try{e(r.parse(a))}catch(l){n?n(l):console.error(l),r.manager.itemError(t)}},i,n)}parse(t){function e(c){let h=new DataView(c),u=32/8*3+32/8*3*3+16/8,d=h.getUint32(80,!0);if(80+32/8+d*u===h.byteLength)return!0;let m=[115,111,108,105,100];for(let x=0;x<5;x++)if(i(m,h,x))return!1;return!0}function i(c,h,u){for(let d=0,f=c.length;d<f;d++)if(c[d]!==h.getUint8(u+d))return!1;return!0}function n(c){let h=new DataView(c),u=h.getUint32(80,!0),d,f,m,x=!1,p,g,_,b,y;for(let L=0;L<=70;L++)h.getUint32(L,!1)==1129270351&&h.getUint8(L+4)==82&&h.getUint8(L+5)==61&&(x=!0,p=new Float32Array(u*3*3),g=h.getUint8(L+6)/255,_=h.getUint8(L+7)/255,b=h.getUint8(L+8)/255,y=h.getUint8(L+9)/255);let M=84,S=50,v=new ce,w=new Float32Array(u*3*3),E=new Float32Array(u*3*3),R=new It;for(let L=0;L<u;L++){let D=M+L*S,U=h.getFloat32(D,!0),N=h.getFloat32(D+4,!0),V=h.getFloat32(D+8,!0);if(x){let k=h.getUint16(D+48,!0);(k&32768)===0?(d=(k&31)/31,f=(k>>5&31)/31,m=(k>>10&31)/31):(d=g,f=_,m=b)}for(let k=1;k<=3;k++){let B=D+k*12,Y=L*3*3+(k-1)*3;w[Y]=h.getFloat32(B,!0),w[Y+1]=h.getFloat32(B+4,!0),w[Y+2]=h.getFloat32(B+8,!0),E[Y]=U,E[Y+1]=N,E[Y+2]=V,x&&(R.setRGB(d,f,m,oe),p[Y]=R.r,p[Y+1]=R.g,p[Y+2]=R.b)}}return v.setAttribute("position",new pi(w,3)),v.setAttribute("normal",new pi(E,3)),x&&(v.setAttribute("color",new pi(p,3)),v.hasColors=!0,v.alpha=y),v}function r(c){let h=new ce,u=/solid([\s\S]*?)endsolid/g,d=/facet([\s\S]*?)endfacet/g,f=/solid\s(.+)/,m=0,x=/[\s]+([+-]?(?:\d*)(?:\.\d*)?(?:[eE][+-]?\d+)?)/.source,p=new RegExp("vertex"+x+x+x,"g"),g=new RegExp("normal"+x+x+x,"g"),_=[],b=[],y=[],M=new C,S,v=0,w=0,E=0;for(;(S=u.exec(c))!==null;){w=E;let R=S[0],L=(S=f.exec(R))!==null?S[1]:"";for(y.push(L);(S=d.exec(R))!==null;){let N=0,V=0,k=S[0];for(;(S=g.exec(k))!==null;)M.x=parseFloat(S[1]),M.y=parseFloat(S[2]),M.z=parseFloat(S[3]),V++;for(;(S=p.exec(k))!==null;)_.push(parseFloat(S[1]),parseFloat(S[2]),parseFloat(S[3])),b.push(M.x,M.y,M.z),N++,E++;V!==1&&console.error("THREE.STLLoader: Something isn't right with the normal of face number "+m),N!==3&&console.error("THREE.STLLoader: Something isn't right with the vertices of face number "+m),m++}let D=w,U=E-w;h.userData.groupNames=y,h.addGroup(D,U,v),v++}return h.setAttribute("position",new Ft(_,3)),h.setAttribute("normal",new Ft(b,3)),h}function o(c){return typeof c!="string"?new TextDecoder().decode(c):c}function a(c){if(typeof c=="string"){let h=new Uint8Array(c.length);for(let u=0;u<c.length;u++)h[u]=c.charCodeAt(u)&255;return h.buffer||h}else return c}let l=a(t);return e(l)?n(l):r(o(t))}};var Uo=class extends xo{constructor(t){super(t)}parse(t){function e(k){switch(k.image_type){case d:case x:if(k.colormap_length>256||k.colormap_size!==24||k.colormap_type!==1)throw new Error("THREE.TGALoader: Invalid type colormap data for indexed type.");break;case f:case m:case p:case g:if(k.colormap_type)throw new Error("THREE.TGALoader: Invalid type colormap data for colormap type.");break;case u:throw new Error("THREE.TGALoader: No data.");default:throw new Error("THREE.TGALoader: Invalid type "+k.image_type)}if(k.width<=0||k.height<=0)throw new Error("THREE.TGALoader: Invalid image size.");if(k.pixel_size!==8&&k.pixel_size!==16&&k.pixel_size!==24&&k.pixel_size!==32)throw new Error("THREE.TGALoader: Invalid pixel size "+k.pixel_size)}function i(k,B,Y,H,$){let Z,ct,ut=Y.pixel_size>>3,G=Y.width*Y.height*ut;if(B&&(ct=$.subarray(H,H+=Y.colormap_length*(Y.colormap_size>>3))),k){Z=new Uint8Array(G);let Q,et,rt,at=0,Lt=new Uint8Array(ut);for(;at<G;)if(Q=$[H++],et=(Q&127)+1,Q&128){for(rt=0;rt<ut;++rt)Lt[rt]=$[H++];for(rt=0;rt<et;++rt)Z.set(Lt,at+rt*ut);at+=ut*et}else{for(et*=ut,rt=0;rt<et;++rt)Z[at+rt]=$[H++];at+=et}}else Z=$.subarray(H,H+=B?Y.width*Y.height:G);return{pixel_data:Z,palettes:ct}}function n(k,B,Y,H,$,Z,ct,ut,G){let Q=G,et=R.colormap_index,rt,at=0,Lt,le,Nt=R.width;for(le=B;le!==H;le+=Y)for(Lt=$;Lt!==ct;Lt+=Z,at++)rt=ut[at]-et,k[(Lt+Nt*le)*4+3]=255,k[(Lt+Nt*le)*4+2]=Q[rt*3+0],k[(Lt+Nt*le)*4+1]=Q[rt*3+1],k[(Lt+Nt*le)*4+0]=Q[rt*3+2];return k}function r(k,B,Y,H,$,Z,ct,ut){let G,Q=0,et,rt,at=R.width;for(rt=B;rt!==H;rt+=Y)for(et=$;et!==ct;et+=Z,Q+=2)G=ut[Q+0]+(ut[Q+1]<<8),k[(et+at*rt)*4+0]=(G&31744)>>7,k[(et+at*rt)*4+1]=(G&992)>>2,k[(et+at*rt)*4+2]=(G&31)<<3,k[(et+at*rt)*4+3]=G&32768?0:255;return k}function o(k,B,Y,H,$,Z,ct,ut){let G=0,Q,et,rt=R.width;for(et=B;et!==H;et+=Y)for(Q=$;Q!==ct;Q+=Z,G+=3)k[(Q+rt*et)*4+3]=255,k[(Q+rt*et)*4+2]=ut[G+0],k[(Q+rt*et)*4+1]=ut[G+1],k[(Q+rt*et)*4+0]=ut[G+2];return k}function a(k,B,Y,H,$,Z,ct,ut){let G=0,Q,et,rt=R.width;for(et=B;et!==H;et+=Y)for(Q=$;Q!==ct;Q+=Z,G+=4)k[(Q+rt*et)*4+2]=ut[G+0],k[(Q+rt*et)*4+1]=ut[G+1],k[(Q+rt*et)*4+0]=ut[G+2],k[(Q+rt*et)*4+3]=ut[G+3];return k}function l(k,B,Y,H,$,Z,ct,ut){let G,Q=0,et,rt,at=R.width;for(rt=B;rt!==H;rt+=Y)for(et=$;et!==ct;et+=Z,Q++)G=ut[Q],k[(et+at*rt)*4+0]=G,k[(et+at*rt)*4+1]=G,k[(et+at*rt)*4+2]=G,k[(et+at*rt)*4+3]=255;return k}function c(k,B,Y,H,$,Z,ct,ut){let G=0,Q,et,rt=R.width;for(et=B;et!==H;et+=Y)for(Q=$;Q!==ct;Q+=Z,G+=2)k[(Q+rt*et)*4+0]=ut[G+0],k[(Q+rt*et)*4+1]=ut[G+0],k[(Q+rt*et)*4+2]=ut[G+0],k[(Q+rt*et)*4+3]=ut[G+1];return k}function h(k,B,Y,H,$){let Z,ct,ut,G,Q,et;switch((R.flags&_)>>b){default:case S:Z=0,ut=1,Q=B,ct=0,G=1,et=Y;break;case y:Z=0,ut=1,Q=B,ct=Y-1,G=-1,et=-1;break;case v:Z=B-1,ut=-1,Q=-1,ct=0,G=1,et=Y;break;case M:Z=B-1,ut=-1,Q=-1,ct=Y-1,G=-1,et=-1;break}if(U)switch(R.pixel_size){case 8:l(k,ct,G,et,Z,ut,Q,H);break;case 16:c(k,ct,G,et,Z,ut,Q,H);break;default:throw new Error("THREE.TGALoader: Format not supported.")}else switch(R.pixel_size){case 8:n(k,ct,G,et,Z,ut,Q,H,$);break;case 16:r(k,ct,G,et,Z,ut,Q,H);break;case 24:o(k,ct,G,et,Z,ut,Q,H);break;case 32:a(k,ct,G,et,Z,ut,Q,H);break;default:throw new Error("THREE.TGALoader: Format not supported.")}return k}let u=0,d=1,f=2,m=3,x=9,p=10,g=11,_=48,b=4,y=0,M=1,S=2,v=3;if(t.length<19)throw new Error("THREE.TGALoader: Not enough data to contain header.");let w=0,E=new Uint8Array(t),R={id_length:E[w++],colormap_type:E[w++],image_type:E[w++],colormap_index:E[w++]|E[w++]<<8,colormap_length:E[w++]|E[w++]<<8,colormap_size:E[w++],origin:[E[w++]|E[w++]<<8,E[w++]|E[w++]<<8],width:E[w++]|E[w++]<<8,height:E[w++]|E[w++]<<8,pixel_size:E[w++],flags:E[w++]};if(e(R),R.id_length+w>t.length)throw new Error("THREE.TGALoader: No data.");w+=R.id_length;let L=!1,D=!1,U=!1;switch(R.image_type){case x:L=!0,D=!0;break;case d:D=!0;break;case p:L=!0;break;case f:break;case g:L=!0,U=!0;break;case m:U=!0;break}let N=new Uint8Array(R.width*R.height*4),V=i(L,D,R,w,E);return h(N,R.width,R.height,V.pixel_data,V.palettes),{data:N,width:R.width,height:R.height,flipY:!0,generateMipmaps:!0,minFilter:ki}}};function vi(s,t){let e=[],i=s.childNodes;for(let n=0,r=i.length;n<r;n++){let o=i[n];o.nodeName===t&&e.push(o)}return e}function hS(s){return s.length===0?[]:s.trim().split(/\s+/)}function oi(s){return s.length===0?[]:s.trim().split(/\s+/).map(parseFloat)}function ec(s){return s.length===0?[]:s.trim().split(/\s+/).map(t=>parseInt(t))}function Xe(s){return s.substring(1)}var ic=class{constructor(){this.count=0}generateId(){return"three_default_"+this.count++}parse(t){if(t.length===0)return null;let e=new DOMParser().parseFromString(t,"application/xml"),i=vi(e,"COLLADA")[0],n=e.getElementsByTagName("parsererror")[0];if(n!==void 0){let l=vi(n,"div")[0],c;return l?c=l.textContent:c=this.parserErrorToText(n),console.error(`THREE.ColladaLoader: Failed to parse collada file.
`,c),null}let r=i.getAttribute("version");console.debug("THREE.ColladaLoader: File version",r);let o=this.parseAsset(vi(i,"asset")[0]),a={animations:{},clips:{},controllers:{},images:{},effects:{},materials:{},cameras:{},lights:{},geometries:{},nodes:{},visualScenes:{},kinematicsModels:{},physicsModels:{},kinematicsScenes:{},joints:{}};return this.library=a,this.collada=i,this.parseLibrary(i,"library_animations","animation",this.parseAnimation.bind(this)),this.parseLibrary(i,"library_animation_clips","animation_clip",this.parseAnimationClip.bind(this)),this.parseLibrary(i,"library_controllers","controller",this.parseController.bind(this)),this.parseLibrary(i,"library_images","image",this.parseImage.bind(this)),this.parseLibrary(i,"library_effects","effect",this.parseEffect.bind(this)),this.parseLibrary(i,"library_materials","material",this.parseMaterial.bind(this)),this.parseLibrary(i,"library_cameras","camera",this.parseCamera.bind(this)),this.parseLibrary(i,"library_lights","light",this.parseLight.bind(this)),this.parseLibrary(i,"library_geometries","geometry",this.parseGeometry.bind(this)),this.parseLibrary(i,"library_nodes","node",this.parseNode.bind(this)),this.parseLibrary(i,"library_visual_scenes","visual_scene",this.parseVisualScene.bind(this)),this.parseLibrary(i,"library_joints","joint",this.parseLibraryJoint.bind(this)),this.parseLibrary(i,"library_kinematics_models","kinematics_model",this.parseKinematicsModel.bind(this)),this.parseLibrary(i,"library_physics_models","physics_model",this.parsePhysicsModel.bind(this)),this.parseLibrary(i,"scene","instance_kinematics_scene",this.parseKinematicsScene.bind(this)),{library:a,asset:o,collada:i}}parserErrorToText(t){let e=[],i=[t];for(;i.length;){let n=i.shift();n.nodeType===Node.TEXT_NODE?e.push(n.textContent):(e.push(`
`),i.push(...n.childNodes))}return e.join("").trim()}parseAsset(t){return{unit:this.parseAssetUnit(vi(t,"unit")[0]),upAxis:this.parseAssetUpAxis(vi(t,"up_axis")[0])}}parseAssetUnit(t){return t!==void 0&&t.hasAttribute("meter")===!0?parseFloat(t.getAttribute("meter")):1}parseAssetUpAxis(t){return t!==void 0?t.textContent:"Y_UP"}parseLibrary(t,e,i,n){let r=vi(t,e)[0];if(r!==void 0){let o=vi(r,i);for(let a=0;a<o.length;a++)n(o[a])}}parseAnimation(t){let e={sources:{},samplers:{},channels:{}},i=!1;for(let n=0,r=t.childNodes.length;n<r;n++){let o=t.childNodes[n];if(o.nodeType!==1)continue;let a;switch(o.nodeName){case"source":a=o.getAttribute("id"),e.sources[a]=this.parseSource(o);break;case"sampler":a=o.getAttribute("id"),e.samplers[a]=this.parseAnimationSampler(o);break;case"channel":a=o.getAttribute("target"),e.channels[a]=this.parseAnimationChannel(o);break;case"animation":this.parseAnimation(o),i=!0;break;default:}}i===!1&&(this.library.animations[t.getAttribute("id")||_i.generateUUID()]=e)}parseAnimationSampler(t){let e={inputs:{}};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1&&r.nodeName==="input"){let o=Xe(r.getAttribute("source")),a=r.getAttribute("semantic");e.inputs[a]=o}}return e}parseAnimationChannel(t){let e={},n=t.getAttribute("target").split("/"),r=n.shift(),o=n.shift(),a=o.indexOf("(")!==-1,l=o.indexOf(".")!==-1;if(l)n=o.split("."),o=n.shift(),e.member=n.shift();else if(a){let c=o.split("(");o=c.shift();for(let h=0;h<c.length;h++)c[h]=parseInt(c[h].replace(/\)/,""));e.indices=c}return e.id=r,e.sid=o,e.arraySyntax=a,e.memberSyntax=l,e.sampler=Xe(t.getAttribute("source")),e}parseAnimationClip(t){let e={name:t.getAttribute("id")||"default",start:parseFloat(t.getAttribute("start")||0),end:parseFloat(t.getAttribute("end")||0),animations:[]};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];r.nodeType===1&&r.nodeName==="instance_animation"&&e.animations.push(Xe(r.getAttribute("url")))}this.library.clips[t.getAttribute("id")]=e}parseController(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"skin":e.id=Xe(r.getAttribute("source")),e.skin=this.parseSkin(r);break;case"morph":e.id=Xe(r.getAttribute("source")),console.warn("THREE.ColladaLoader: Morph target animation not supported yet.");break}}this.library.controllers[t.getAttribute("id")]=e}parseSkin(t){let e={sources:{}};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"bind_shape_matrix":e.bindShapeMatrix=oi(r.textContent);break;case"source":let o=r.getAttribute("id");e.sources[o]=this.parseSource(r);break;case"joints":e.joints=this.parseJoints(r);break;case"vertex_weights":e.vertexWeights=this.parseVertexWeights(r);break}}return e}parseJoints(t){let e={inputs:{}};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1&&r.nodeName==="input"){let o=r.getAttribute("semantic"),a=Xe(r.getAttribute("source"));e.inputs[o]=a}}return e}parseVertexWeights(t){let e={inputs:{}};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"input":let o=r.getAttribute("semantic"),a=Xe(r.getAttribute("source")),l=parseInt(r.getAttribute("offset"));e.inputs[o]={id:a,offset:l};break;case"vcount":e.vcount=ec(r.textContent);break;case"v":e.v=ec(r.textContent);break}}return e}parseImage(t){let e={init_from:vi(t,"init_from")[0].textContent};this.library.images[t.getAttribute("id")]=e}parseEffect(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];r.nodeType===1&&r.nodeName==="profile_COMMON"&&(e.profile=this.parseEffectProfileCOMMON(r))}this.library.effects[t.getAttribute("id")]=e}parseEffectProfileCOMMON(t){let e={surfaces:{},samplers:{}};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"newparam":this.parseEffectNewparam(r,e);break;case"technique":e.technique=this.parseEffectTechnique(r);break;case"extra":e.extra=this.parseEffectExtra(r);break}}return e}parseEffectNewparam(t,e){let i=t.getAttribute("sid");for(let n=0,r=t.childNodes.length;n<r;n++){let o=t.childNodes[n];if(o.nodeType===1)switch(o.nodeName){case"surface":e.surfaces[i]=this.parseEffectSurface(o);break;case"sampler2D":e.samplers[i]=this.parseEffectSampler(o);break}}}parseEffectSurface(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];r.nodeType===1&&r.nodeName==="init_from"&&(e.init_from=r.textContent)}return e}parseEffectSampler(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];r.nodeType===1&&r.nodeName==="source"&&(e.source=r.textContent)}return e}parseEffectTechnique(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"constant":case"lambert":case"blinn":case"phong":e.type=r.nodeName,e.parameters=this.parseEffectParameters(r);break;case"extra":e.extra=this.parseEffectExtra(r);break}}return e}parseEffectParameters(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"emission":case"diffuse":case"specular":case"bump":case"ambient":case"shininess":case"transparency":e[r.nodeName]=this.parseEffectParameter(r);break;case"transparent":e[r.nodeName]={opaque:r.hasAttribute("opaque")?r.getAttribute("opaque"):"A_ONE",data:this.parseEffectParameter(r)};break}}return e}parseEffectParameter(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"color":e[r.nodeName]=oi(r.textContent);break;case"float":e[r.nodeName]=parseFloat(r.textContent);break;case"texture":e[r.nodeName]={id:r.getAttribute("texture"),extra:this.parseEffectParameterTexture(r)};break}}return e}parseEffectParameterTexture(t){let e={technique:{}};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];r.nodeType===1&&r.nodeName==="extra"&&this.parseEffectParameterTextureExtra(r,e)}return e}parseEffectParameterTextureExtra(t,e){for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];r.nodeType===1&&r.nodeName==="technique"&&this.parseEffectParameterTextureExtraTechnique(r,e)}}parseEffectParameterTextureExtraTechnique(t,e){for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"repeatU":case"repeatV":case"offsetU":case"offsetV":e.technique[r.nodeName]=parseFloat(r.textContent);break;case"wrapU":case"wrapV":r.textContent.toUpperCase()==="TRUE"?e.technique[r.nodeName]=1:r.textContent.toUpperCase()==="FALSE"?e.technique[r.nodeName]=0:e.technique[r.nodeName]=parseInt(r.textContent);break;case"bump":e[r.nodeName]=this.parseEffectExtraTechniqueBump(r);break}}}parseEffectExtra(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];r.nodeType===1&&r.nodeName==="technique"&&(e.technique=this.parseEffectExtraTechnique(r))}return e}parseEffectExtraTechnique(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"double_sided":e[r.nodeName]=parseInt(r.textContent);break;case"bump":e[r.nodeName]=this.parseEffectExtraTechniqueBump(r);break}}return e}parseEffectExtraTechniqueBump(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];r.nodeType===1&&r.nodeName==="texture"&&(e[r.nodeName]={id:r.getAttribute("texture"),texcoord:r.getAttribute("texcoord"),extra:this.parseEffectParameterTexture(r)})}return e}parseMaterial(t){let e={name:t.getAttribute("name")};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];r.nodeType===1&&r.nodeName==="instance_effect"&&(e.url=Xe(r.getAttribute("url")))}this.library.materials[t.getAttribute("id")]=e}parseCamera(t){let e={name:t.getAttribute("name")};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];r.nodeType===1&&r.nodeName==="optics"&&(e.optics=this.parseCameraOptics(r))}this.library.cameras[t.getAttribute("id")]=e}parseCameraOptics(t){for(let e=0;e<t.childNodes.length;e++){let i=t.childNodes[e];if(i.nodeName==="technique_common")return this.parseCameraTechnique(i)}return{}}parseCameraTechnique(t){let e={};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];switch(n.nodeName){case"perspective":case"orthographic":e.technique=n.nodeName,e.parameters=this.parseCameraParameters(n);break}}return e}parseCameraParameters(t){let e={};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];switch(n.nodeName){case"xfov":case"yfov":case"xmag":case"ymag":case"znear":case"zfar":case"aspect_ratio":e[n.nodeName]=parseFloat(n.textContent);break}}return e}parseLight(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];r.nodeType===1&&r.nodeName==="technique_common"&&(e=this.parseLightTechnique(r))}this.library.lights[t.getAttribute("id")]=e}parseLightTechnique(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"directional":case"point":case"spot":case"ambient":e.technique=r.nodeName,e.parameters=this.parseLightParameters(r);break}}return e}parseLightParameters(t){let e={};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"color":let o=oi(r.textContent);e.color=new It().fromArray(o),Ht.colorSpaceToWorking(e.color,oe);break;case"falloff_angle":e.falloffAngle=parseFloat(r.textContent);break;case"quadratic_attenuation":let a=parseFloat(r.textContent);e.distance=a?Math.sqrt(1/a):0;break}}return e}parseGeometry(t){let e={name:t.getAttribute("name"),sources:{},vertices:{},primitives:[]},i=vi(t,"mesh")[0];if(i!==void 0){for(let n=0;n<i.childNodes.length;n++){let r=i.childNodes[n];if(r.nodeType!==1)continue;let o=r.getAttribute("id");switch(r.nodeName){case"source":e.sources[o]=this.parseSource(r);break;case"vertices":e.vertices=this.parseGeometryVertices(r);break;case"polygons":case"lines":case"linestrips":case"polylist":case"triangles":e.primitives.push(this.parseGeometryPrimitive(r));break;default:}}this.library.geometries[t.getAttribute("id")]=e}}parseSource(t){let e={array:[],stride:3};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];if(n.nodeType===1)switch(n.nodeName){case"float_array":e.array=oi(n.textContent);break;case"Name_array":e.array=hS(n.textContent);break;case"technique_common":let r=vi(n,"accessor")[0];r!==void 0&&(e.stride=parseInt(r.getAttribute("stride")));break}}return e}parseGeometryVertices(t){let e={};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];n.nodeType===1&&(e[n.getAttribute("semantic")]=Xe(n.getAttribute("source")))}return e}parseGeometryPrimitive(t){let e={type:t.nodeName,material:t.getAttribute("material"),count:parseInt(t.getAttribute("count")),inputs:{},stride:0,hasUV:!1};for(let i=0,n=t.childNodes.length;i<n;i++){let r=t.childNodes[i];if(r.nodeType===1)switch(r.nodeName){case"input":let o=Xe(r.getAttribute("source")),a=r.getAttribute("semantic"),l=parseInt(r.getAttribute("offset")),c=parseInt(r.getAttribute("set")),h=c>0?a+c:a;e.inputs[h]={id:o,offset:l},e.stride=Math.max(e.stride,l+1),a==="TEXCOORD"&&(e.hasUV=!0);break;case"vcount":e.vcount=ec(r.textContent);break;case"p":e.p=ec(r.textContent);break}}return e.type==="polygons"&&(e.vcount=[e.p.length/e.stride]),e}parseLibraryJoint(t){this.library.joints[t.getAttribute("id")]=this.parseKinematicsJoint(t)}parseKinematicsModel(t){let e={name:t.getAttribute("name")||"",joints:{},links:[]};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];n.nodeType===1&&n.nodeName==="technique_common"&&this.parseKinematicsTechniqueCommon(n,e)}this.library.kinematicsModels[t.getAttribute("id")]=e}parseKinematicsTechniqueCommon(t,e){for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];if(n.nodeType===1)switch(n.nodeName){case"joint":e.joints[n.getAttribute("sid")]=this.parseKinematicsJoint(n);break;case"instance_joint":e.joints[n.getAttribute("sid")]=this.library.joints[Xe(n.getAttribute("url"))];break;case"link":e.links.push(this.parseKinematicsLink(n));break}}}parseKinematicsJoint(t){let e;for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];if(n.nodeType===1)switch(n.nodeName){case"prismatic":case"revolute":e=this.parseKinematicsJointParameter(n);break}}return e}parseKinematicsJointParameter(t){let e={sid:t.getAttribute("sid"),name:t.getAttribute("name")||"",axis:new C,limits:{min:0,max:0},type:t.nodeName,static:!1,zeroPosition:0,middlePosition:0};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];if(n.nodeType===1)switch(n.nodeName){case"axis":let r=oi(n.textContent);e.axis.fromArray(r);break;case"limits":let o=n.getElementsByTagName("max")[0],a=n.getElementsByTagName("min")[0];e.limits.max=parseFloat(o.textContent),e.limits.min=parseFloat(a.textContent);break}}return e.limits.min>=e.limits.max&&(e.static=!0),e.middlePosition=(e.limits.min+e.limits.max)/2,e}parseKinematicsLink(t){let e={sid:t.getAttribute("sid"),name:t.getAttribute("name")||"",attachments:[],transforms:[]};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];if(n.nodeType===1)switch(n.nodeName){case"attachment_full":e.attachments.push(this.parseKinematicsAttachment(n));break;case"matrix":case"translate":case"rotate":e.transforms.push(this.parseKinematicsTransform(n));break}}return e}parseKinematicsAttachment(t){let e={joint:t.getAttribute("joint").split("/").pop(),transforms:[],links:[]};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];if(n.nodeType===1)switch(n.nodeName){case"link":e.links.push(this.parseKinematicsLink(n));break;case"matrix":case"translate":case"rotate":e.transforms.push(this.parseKinematicsTransform(n));break}}return e}parseKinematicsTransform(t){let e={type:t.nodeName},i=oi(t.textContent);switch(e.type){case"matrix":e.obj=new wt,e.obj.fromArray(i).transpose();break;case"translate":e.obj=new C,e.obj.fromArray(i);break;case"rotate":e.obj=new C,e.obj.fromArray(i),e.angle=_i.degToRad(i[3]);break}return e}parsePhysicsModel(t){let e={name:t.getAttribute("name")||"",rigidBodies:{}};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];n.nodeType===1&&n.nodeName==="rigid_body"&&(e.rigidBodies[n.getAttribute("name")]={},this.parsePhysicsRigidBody(n,e.rigidBodies[n.getAttribute("name")]))}this.library.physicsModels[t.getAttribute("id")]=e}parsePhysicsRigidBody(t,e){for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];n.nodeType===1&&n.nodeName==="technique_common"&&this.parsePhysicsTechniqueCommon(n,e)}}parsePhysicsTechniqueCommon(t,e){for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];if(n.nodeType===1)switch(n.nodeName){case"inertia":e.inertia=oi(n.textContent);break;case"mass":e.mass=oi(n.textContent)[0];break}}}parseKinematicsScene(t){let e={bindJointAxis:[]};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];n.nodeType===1&&n.nodeName==="bind_joint_axis"&&e.bindJointAxis.push(this.parseKinematicsBindJointAxis(n))}this.library.kinematicsScenes[Xe(t.getAttribute("url"))]=e}parseKinematicsBindJointAxis(t){let e={target:t.getAttribute("target").split("/").pop()};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];if(n.nodeType===1&&n.nodeName==="axis"){let r=n.getElementsByTagName("param")[0];e.axis=r.textContent;let o=e.axis.split("inst_").pop().split("axis")[0];e.jointIndex=o.substring(0,o.length-1)}}return e}prepareNodes(t){let e=t.getElementsByTagName("node");for(let i=0;i<e.length;i++){let n=e[i];n.hasAttribute("id")===!1&&n.setAttribute("id",this.generateId())}}parseNode(t){let e=new wt,i=new C,n={name:t.getAttribute("name")||"",type:t.getAttribute("type"),id:t.getAttribute("id"),sid:t.getAttribute("sid"),matrix:new wt,nodes:[],instanceCameras:[],instanceControllers:[],instanceLights:[],instanceGeometries:[],instanceNodes:[],transforms:{},transformData:{},transformOrder:[]};for(let r=0;r<t.childNodes.length;r++){let o=t.childNodes[r];if(o.nodeType!==1)continue;let a;switch(o.nodeName){case"node":n.nodes.push(o.getAttribute("id")),this.parseNode(o);break;case"instance_camera":n.instanceCameras.push(Xe(o.getAttribute("url")));break;case"instance_controller":n.instanceControllers.push(this.parseNodeInstance(o));break;case"instance_light":n.instanceLights.push(Xe(o.getAttribute("url")));break;case"instance_geometry":n.instanceGeometries.push(this.parseNodeInstance(o));break;case"instance_node":n.instanceNodes.push(Xe(o.getAttribute("url")));break;case"matrix":a=oi(o.textContent),n.matrix.multiply(e.fromArray(a).transpose());{let l=o.getAttribute("sid");n.transforms[l]=o.nodeName,n.transformData[l]={type:"matrix",array:a},n.transformOrder.push(l)}break;case"translate":a=oi(o.textContent),i.fromArray(a),n.matrix.multiply(e.makeTranslation(i.x,i.y,i.z));{let l=o.getAttribute("sid");n.transforms[l]=o.nodeName,n.transformData[l]={type:"translate",x:a[0],y:a[1],z:a[2]},n.transformOrder.push(l)}break;case"rotate":a=oi(o.textContent);{let l=_i.degToRad(a[3]);n.matrix.multiply(e.makeRotationAxis(i.fromArray(a),l));let c=o.getAttribute("sid");n.transforms[c]=o.nodeName,n.transformData[c]={type:"rotate",axis:[a[0],a[1],a[2]],angle:a[3]},n.transformOrder.push(c)}break;case"scale":a=oi(o.textContent),n.matrix.scale(i.fromArray(a));{let l=o.getAttribute("sid");n.transforms[l]=o.nodeName,n.transformData[l]={type:"scale",x:a[0],y:a[1],z:a[2]},n.transformOrder.push(l)}break;case"extra":break;default:}}return this.hasNode(n.id)?console.warn("THREE.ColladaLoader: There is already a node with ID %s. Exclude current node from further processing.",n.id):this.library.nodes[n.id]=n,n}parseNodeInstance(t){let e={id:Xe(t.getAttribute("url")),materials:{},skeletons:[]};for(let i=0;i<t.childNodes.length;i++){let n=t.childNodes[i];switch(n.nodeName){case"bind_material":let r=n.getElementsByTagName("instance_material");for(let o=0;o<r.length;o++){let a=r[o],l=a.getAttribute("symbol"),c=a.getAttribute("target");e.materials[l]=Xe(c)}break;case"skeleton":e.skeletons.push(Xe(n.textContent));break;default:break}}return e}parseVisualScene(t){let e={name:t.getAttribute("name"),children:[]};this.prepareNodes(t);let i=vi(t,"node");for(let n=0;n<i.length;n++)e.children.push(this.parseNode(i[n]));this.library.visualScenes[t.getAttribute("id")]=e}hasNode(t){return this.library.nodes[t]!==void 0}};var nc=class{constructor(t,e,i,n){this.library=t,this.collada=e,this.textureLoader=i,this.tgaLoader=n,this.tempColor=new It,this.animations=[],this.kinematics={},this.position=new C,this.scale=new C,this.quaternion=new Wt,this.matrix=new wt,this.deferredPivotAnimations={},this.transformNodes={}}compose(){let t=this.library;this.buildLibrary(t.animations,this.buildAnimation.bind(this)),this.buildLibrary(t.clips,this.buildAnimationClip.bind(this)),this.buildLibrary(t.controllers,this.buildController.bind(this)),this.buildLibrary(t.images,this.buildImage.bind(this)),this.buildLibrary(t.effects,this.buildEffect.bind(this)),this.buildLibrary(t.materials,this.buildMaterial.bind(this)),this.buildLibrary(t.cameras,this.buildCamera.bind(this)),this.buildLibrary(t.lights,this.buildLight.bind(this)),this.buildLibrary(t.geometries,this.buildGeometry.bind(this)),this.buildLibrary(t.visualScenes,this.buildVisualScene.bind(this)),this.setupAnimations(),this.setupKinematics();let e=this.parseScene(vi(this.collada,"scene")[0]);return e.animations=this.animations,{scene:e,animations:this.animations,kinematics:this.kinematics}}buildLibrary(t,e){for(let i in t){let n=t[i];n.build=e(t[i])}}getBuild(t,e){return t.build!==void 0||(t.build=e(t)),t.build}isEmpty(t){return Object.keys(t).length===0}buildAnimation(t){let e=[],i=t.channels,n=t.samplers,r=t.sources,o=this.aggregateAnimationChannels(i,n,r);for(let a in o){let l=this.library.nodes[a];if(!l)continue;let c=o[a];if(this.hasPivotTransforms(l))this.collectDeferredPivotAnimation(a,c);else{let h=this.getNode(a),u=!1;for(let d in c){let f=l.transforms[d],m=l.transformData[d],x=c[d];switch(f){case"matrix":this.buildMatrixTracks(h,x,l,e);break;case"translate":this.buildTranslateTrack(h,x,m,e);break;case"rotate":u||(this.buildRotateTrack(h,d,x,m,l,e),u=!0);break;case"scale":this.buildScaleTrack(h,x,m,e);break}}}}return e}collectDeferredPivotAnimation(t,e){this.deferredPivotAnimations[t]||(this.deferredPivotAnimations[t]={});let i=this.deferredPivotAnimations[t];for(let n in e){i[n]||(i[n]={});for(let r in e[n])i[n][r]=e[n][r]}}hasPivotTransforms(t){let e=["rotatePivot","rotatePivotInverse","rotatePivotTranslation","scalePivot","scalePivotInverse","scalePivotTranslation"];for(let i of e)if(t.transforms[i]!==void 0)return!0;return!1}getAnimation(t){return this.getBuild(this.library.animations[t],this.buildAnimation.bind(this))}aggregateAnimationChannels(t,e,i){let n={};for(let r in t){if(!t.hasOwnProperty(r))continue;let o=t[r],a=e[o.sampler],l=a.inputs.INPUT,c=a.inputs.OUTPUT,h=i[l],u=i[c],d=a.inputs.INTERPOLATION,f=a.inputs.IN_TANGENT,m=a.inputs.OUT_TANGENT,x=d?i[d]:null,p=f?i[f]:null,g=m?i[m]:null,_=o.id,b=o.sid,y=o.member||"default";n[_]||(n[_]={}),n[_][b]||(n[_][b]={}),n[_][b][y]={times:h.array,values:u.array,stride:u.stride,arraySyntax:o.arraySyntax,indices:o.indices,interpolation:x?x.array:null,inTangent:p?p.array:null,outTangent:g?g.array:null,inTangentStride:p?p.stride:0,outTangentStride:g?g.stride:0}}return n}buildMatrixTracks(t,e,i,n){let r=i.matrix.clone().transpose(),o={};for(let c in e){let h=e[c],u=h.times,d=h.values,f=h.stride;for(let m=0,x=u.length;m<x;m++){let p=u[m],g=m*f;if(o[p]===void 0&&(o[p]={}),h.arraySyntax===!0){let _=d[g],b=h.indices[0]+4*h.indices[1];o[p][b]=_}else for(let _=0;_<f;_++)o[p][_]=d[g+_]}}let a=this.prepareAnimationData(o,r),l={name:t.uuid,keyframes:a};this.createKeyframeTracks(l,n)}buildTranslateTrack(t,e,i,n){if(e.default&&e.default.stride===3){let c=e.default,h=Array.from(c.times),u=Array.from(c.values),d=new ii(t.uuid+".position",h,u),f=this.getInterpolationInfo(e);this.applyInterpolation(d,f,e),n.push(d);return}let r=this.getTimesForAllAxes(e);if(r.length===0)return;let o=[],a=this.getInterpolationInfo(e);for(let c=0;c<r.length;c++){let h=r[c],u=this.getValueAtTime(e.X,h,i.x),d=this.getValueAtTime(e.Y,h,i.y),f=this.getValueAtTime(e.Z,h,i.z);o.push(u,d,f)}let l=new ii(t.uuid+".position",r,o);this.applyInterpolation(l,a),n.push(l)}buildRotateTrack(t,e,i,n,r,o){let a=i.ANGLE||i.default;if(!a)return;let l=Array.from(a.times);if(l.length===0)return;let c=[];for(let p of r.transformOrder)if(r.transforms[p]==="rotate"){let _=r.transformData[p];c.push({sid:p,axis:new C(_.axis[0],_.axis[1],_.axis[2]),defaultAngle:_.angle})}let h=new Wt,u=new Wt,d=new Wt,f=[],m=this.getInterpolationInfo(i);for(let p=0;p<l.length;p++){let g=l[p];h.identity();for(let _ of c){let b;_.sid===e?b=this.getValueAtTime(a,g,_.defaultAngle):b=_.defaultAngle;let y=_i.degToRad(b);d.setFromAxisAngle(_.axis,y),h.multiply(d)}p>0&&u.dot(h)<0&&(h.x=-h.x,h.y=-h.y,h.z=-h.z,h.w=-h.w),u.copy(h),f.push(h.x,h.y,h.z,h.w)}let x=new ln(t.uuid+".quaternion",l,f);this.applyInterpolation(x,m),o.push(x)}buildScaleTrack(t,e,i,n){if(e.default&&e.default.stride===3){let c=e.default,h=Array.from(c.times),u=Array.from(c.values),d=new ii(t.uuid+".scale",h,u),f=this.getInterpolationInfo(e);this.applyInterpolation(d,f,e),n.push(d);return}let r=this.getTimesForAllAxes(e);if(r.length===0)return;let o=[],a=this.getInterpolationInfo(e);for(let c=0;c<r.length;c++){let h=r[c],u=this.getValueAtTime(e.X,h,i.x),d=this.getValueAtTime(e.Y,h,i.y),f=this.getValueAtTime(e.Z,h,i.z);o.push(u,d,f)}let l=new ii(t.uuid+".scale",r,o);this.applyInterpolation(l,a),n.push(l)}getTimesForAllAxes(t){let e=[];return t.X&&(e=e.concat(Array.from(t.X.times))),t.Y&&(e=e.concat(Array.from(t.Y.times))),t.Z&&(e=e.concat(Array.from(t.Z.times))),t.ANGLE&&(e=e.concat(Array.from(t.ANGLE.times))),t.default&&(e=e.concat(Array.from(t.default.times))),e=[...new Set(e)].sort((i,n)=>i-n),e}getValueAtTime(t,e,i){if(!t)return i;let n=t.times,r=t.values,o=t.interpolation;for(let a=0;a<n.length;a++){if(n[a]===e)return r[a];if(n[a]>e){if(a===0)return r[0];let l=a-1,c=a,h=n[l],u=n[c],d=r[l],f=r[c],m=o?o[l]:"LINEAR";if(m==="STEP")return d;if(m==="BEZIER"&&t.inTangent&&t.outTangent)return this.evaluateBezierComponent(t,l,c,h,u,e);{let x=(e-h)/(u-h);return d+x*(f-d)}}}return r[r.length-1]}evaluateBezierComponent(t,e,i,n,r,o){let a=t.values,l=t.inTangent,c=t.outTangent,h=t.inTangentStride||1,u=a[e],d=a[i],f,m,x,p;h===2?(f=c[e*2],m=c[e*2+1],x=l[i*2],p=l[i*2+1]):(f=n+(r-n)/3,m=c[e],x=r-(r-n)/3,p=l[i]);let g=(o-n)/(r-n);for(let v=0;v<8;v++){let w=g*g,E=w*g,R=1-g,L=R*R,U=L*R*n+3*L*g*f+3*R*w*x+E*r,N=3*L*(f-n)+6*R*g*(x-f)+3*w*(r-x);if(Math.abs(N)<1e-10)break;let V=U-o;if(Math.abs(V)<1e-10)break;g=g-V/N,g=Math.max(0,Math.min(1,g))}let _=g*g,b=_*g,y=1-g,M=y*y;return M*y*u+3*M*g*m+3*y*_*p+b*d}getInterpolationInfo(t){let e=["X","Y","Z","ANGLE","default"],i=null,n=!0;for(let r of e){let o=t[r];if(!o||!o.interpolation)continue;let a=o.interpolation;for(let l=0;l<a.length;l++){let c=a[l];i===null?i=c:c!==i&&(n=!1)}}return{type:i||"LINEAR",uniform:n}}applyInterpolation(t,e,i=null){if(e.type==="STEP"&&e.uniform)t.setInterpolation(xs);else if(e.type==="BEZIER"&&e.uniform&&i){let n=i.default;n&&n.inTangent&&n.outTangent&&(t.setInterpolation(Qr),t.settings={inTangents:new Float32Array(n.inTangent),outTangents:new Float32Array(n.outTangent)})}}prepareAnimationData(t,e){let i=[];for(let n in t)i.push({time:parseFloat(n),value:t[n]});i.sort((n,r)=>n.time-r.time);for(let n=0;n<16;n++)this.transformAnimationData(i,n,e.elements[n]);return i}createKeyframeTracks(t,e){let i=t.keyframes,n=t.name,r=[],o=[],a=[],l=[],c=this.position,h=this.quaternion,u=this.scale,d=this.matrix;for(let f=0,m=i.length;f<m;f++){let x=i[f],p=x.time,g=x.value;d.fromArray(g).transpose(),d.decompose(c,h,u),r.push(p),o.push(c.x,c.y,c.z),a.push(h.x,h.y,h.z,h.w),l.push(u.x,u.y,u.z)}return o.length>0&&e.push(new ii(n+".position",r,o)),a.length>0&&e.push(new ln(n+".quaternion",r,a)),l.length>0&&e.push(new ii(n+".scale",r,l)),e}transformAnimationData(t,e,i){let n,r=!0,o,a;for(o=0,a=t.length;o<a;o++)n=t[o],n.value[e]===void 0?n.value[e]=null:r=!1;if(r===!0)for(o=0,a=t.length;o<a;o++)n=t[o],n.value[e]=i;else this.createMissingKeyframes(t,e)}createMissingKeyframes(t,e){let i,n;for(let r=0,o=t.length;r<o;r++){let a=t[r];if(a.value[e]===null){if(i=this.getPrev(t,r,e),n=this.getNext(t,r,e),i===null){a.value[e]=n.value[e];continue}if(n===null){a.value[e]=i.value[e];continue}this.interpolate(a,i,n,e)}}}getPrev(t,e,i){for(;e>=0;){let n=t[e];if(n.value[i]!==null)return n;e--}return null}getNext(t,e,i){for(;e<t.length;){let n=t[e];if(n.value[i]!==null)return n;e++}return null}interpolate(t,e,i,n){if(i.time-e.time===0){t.value[n]=e.value[n];return}t.value[n]=(t.time-e.time)*(i.value[n]-e.value[n])/(i.time-e.time)+e.value[n]}buildAnimationClip(t){let e=[],i=t.name,n=t.end-t.start||-1,r=t.animations;for(let o=0,a=r.length;o<a;o++){let l=this.getAnimation(r[o]);for(let c=0,h=l.length;c<h;c++)e.push(l[c])}return new _r(i,n,e)}getAnimationClip(t){return this.getBuild(this.library.clips[t],this.buildAnimationClip.bind(this))}buildController(t){let e={id:t.id},i=this.library.geometries[e.id];return t.skin!==void 0&&(e.skin=this.buildSkin(t.skin),i.sources.skinIndices=e.skin.indices,i.sources.skinWeights=e.skin.weights),e}buildSkin(t){let i={joints:[],indices:{array:[],stride:4},weights:{array:[],stride:4}},n=t.sources,r=t.vertexWeights,o=r.vcount,a=r.v,l=r.inputs.JOINT.offset,c=r.inputs.WEIGHT.offset,h=t.sources[t.joints.inputs.JOINT],u=t.sources[t.joints.inputs.INV_BIND_MATRIX],d=n[r.inputs.WEIGHT.id].array,f=0,m,x,p;for(m=0,p=o.length;m<p;m++){let _=o[m],b=[];for(x=0;x<_;x++){let y=a[f+l],M=a[f+c],S=d[M];b.push({index:y,weight:S}),f+=2}for(b.sort(g),x=0;x<4;x++){let y=b[x];y!==void 0?(i.indices.array.push(y.index),i.weights.array.push(y.weight)):(i.indices.array.push(0),i.weights.array.push(0))}}for(t.bindShapeMatrix?i.bindMatrix=new wt().fromArray(t.bindShapeMatrix).transpose():i.bindMatrix=new wt().identity(),m=0,p=h.array.length;m<p;m++){let _=h.array[m],b=new wt().fromArray(u.array,m*u.stride).transpose();i.joints.push({name:_,boneInverse:b})}return i;function g(_,b){return b.weight-_.weight}}getController(t){return this.getBuild(this.library.controllers[t],this.buildController.bind(this))}buildImage(t){return t.build!==void 0?t.build:t.init_from}getImage(t){let e=this.library.images[t];return e!==void 0?this.getBuild(e,this.buildImage.bind(this)):(console.warn("THREE.ColladaLoader: Couldn't find image with ID:",t),null)}buildEffect(t){return t}getEffect(t){return this.getBuild(this.library.effects[t],this.buildEffect.bind(this))}getTextureLoader(t){let e,i=t.slice((t.lastIndexOf(".")-1>>>0)+2);return i=i.toLowerCase(),i==="tga"?e=this.tgaLoader:e=this.textureLoader,e}buildMaterial(t){let e=this.getEffect(t.url),i=e.profile.technique,n;switch(i.type){case"phong":case"blinn":n=new gi;break;case"lambert":n=new Ms;break;default:n=new ti;break}n.name=t.name||"";let r=this;function o(h,u=null){let d=e.profile.samplers[h.id],f=null;if(d!==void 0){let m=e.profile.surfaces[d.source];f=r.getImage(m.init_from)}else console.warn("THREE.ColladaLoader: Undefined sampler. Access image directly (see #12530)."),f=r.getImage(h.id);if(f!==null){let m=r.getTextureLoader(f);if(m!==void 0){let x=m.load(f),p=h.extra;if(p!==void 0&&p.technique!==void 0&&r.isEmpty(p.technique)===!1){let g=p.technique;x.wrapS=g.wrapU?Mn:ci,x.wrapT=g.wrapV?Mn:ci,x.offset.set(g.offsetU||0,g.offsetV||0),x.repeat.set(g.repeatU||1,g.repeatV||1)}else x.wrapS=Mn,x.wrapT=Mn;return u!==null&&(x.colorSpace=u),x}else return console.warn("THREE.ColladaLoader: Loader for texture %s not found.",f),null}else return console.warn("THREE.ColladaLoader: Couldn't create texture with ID:",h.id),null}let a=i.parameters;for(let h in a){let u=a[h];switch(h){case"diffuse":u.color&&n.color.fromArray(u.color),u.texture&&(n.map=o(u.texture,oe));break;case"specular":u.color&&n.specular&&n.specular.fromArray(u.color),u.texture&&(n.specularMap=o(u.texture));break;case"bump":u.texture&&(n.normalMap=o(u.texture));break;case"ambient":u.texture&&(n.lightMap=o(u.texture,oe));break;case"shininess":u.float&&n.shininess&&(n.shininess=u.float);break;case"emission":u.color&&n.emissive&&n.emissive.fromArray(u.color),u.texture&&(n.emissiveMap=o(u.texture,oe));break}}Ht.colorSpaceToWorking(n.color,oe),n.specular&&Ht.colorSpaceToWorking(n.specular,oe),n.emissive&&Ht.colorSpaceToWorking(n.emissive,oe);let l=a.transparent,c=a.transparency;if(c===void 0&&l&&(c={float:1}),l===void 0&&c&&(l={opaque:"A_ONE",data:{color:[1,1,1,1]}}),l&&c)if(l.data.texture)n.transparent=!0;else{let h=l.data.color;switch(l.opaque){case"A_ONE":n.opacity=h[3]*c.float;break;case"RGB_ZERO":n.opacity=1-h[0]*c.float;break;case"A_ZERO":n.opacity=1-h[3]*c.float;break;case"RGB_ONE":n.opacity=h[0]*c.float;break;default:console.warn('THREE.ColladaLoader: Invalid opaque type "%s" of transparent tag.',l.opaque)}n.opacity<1&&(n.transparent=!0)}if(i.extra!==void 0&&i.extra.technique!==void 0){let h=i.extra.technique;for(let u in h){let d=h[u];switch(u){case"double_sided":n.side=d===1?si:cn;break;case"bump":n.normalMap=o(d.texture),n.normalScale=new Rt(1,1);break}}}return n}getMaterial(t){return this.getBuild(this.library.materials[t],this.buildMaterial.bind(this))}buildCamera(t){let e;switch(t.optics.technique){case"perspective":e=new Ce(t.optics.parameters.yfov,t.optics.parameters.aspect_ratio,t.optics.parameters.znear,t.optics.parameters.zfar);break;case"orthographic":let i=t.optics.parameters.ymag,n=t.optics.parameters.xmag,r=t.optics.parameters.aspect_ratio;n=n===void 0?i*r:n,i=i===void 0?n/r:i,n*=.5,i*=.5,e=new As(-n,n,i,-i,t.optics.parameters.znear,t.optics.parameters.zfar);break;default:e=new Ce;break}return e.name=t.name||"",e}getCamera(t){let e=this.library.cameras[t];return e!==void 0?this.getBuild(e,this.buildCamera.bind(this)):(console.warn("THREE.ColladaLoader: Couldn't find camera with ID:",t),null)}buildLight(t){let e;switch(t.technique){case"directional":e=new $n;break;case"point":e=new bo;break;case"spot":e=new vo;break;case"ambient":e=new Es;break}return t.parameters.color&&e.color.copy(t.parameters.color),t.parameters.distance&&(e.distance=t.parameters.distance),t.parameters.falloffAngle&&(e.angle=_i.degToRad(t.parameters.falloffAngle)),e}getLight(t){let e=this.library.lights[t];return e!==void 0?this.getBuild(e,this.buildLight.bind(this)):(console.warn("THREE.ColladaLoader: Couldn't find light with ID:",t),null)}groupPrimitives(t){let e={};for(let i=0;i<t.length;i++){let n=t[i];e[n.type]===void 0&&(e[n.type]=[]),e[n.type].push(n)}return e}checkUVCoordinates(t){let e=0;for(let i=0,n=t.length;i<n;i++)t[i].hasUV===!0&&e++;e>0&&e<t.length&&(t.uvsNeedsFix=!0)}buildGeometry(t){let e={},i=t.sources,n=t.vertices,r=t.primitives;if(r.length===0)return{};let o=this.groupPrimitives(r);for(let a in o){let l=o[a];this.checkUVCoordinates(l),e[a]=this.buildGeometryType(l,i,n)}return e}buildGeometryType(t,e,i){let n={},r={array:[],stride:0},o={array:[],stride:0},a={array:[],stride:0},l={array:[],stride:0},c={array:[],stride:0},h={array:[],stride:4},u={array:[],stride:4},d=new ce,f=[],m=0;for(let x=0;x<t.length;x++){let p=t[x],g=p.inputs,_=0;switch(p.type){case"lines":case"linestrips":_=p.count*2;break;case"triangles":_=p.count*3;break;case"polygons":case"polylist":for(let b=0;b<p.count;b++){let y=p.vcount[b];switch(y){case 3:_+=3;break;case 4:_+=6;break;default:_+=(y-2)*3;break}}break;default:console.warn("THREE.ColladaLoader: Unknown primitive type:",p.type)}d.addGroup(m,_,x),m+=_,p.material&&f.push(p.material),p.positionSource=e[i.POSITION],p.positionOffset=g.VERTEX.offset;for(let b in g){let y=g[b];switch(b){case"VERTEX":for(let M in i){let S=i[M];switch(M){case"POSITION":let v=r.array.length;if(this.buildGeometryData(p,e[S],y.offset,r.array),r.stride=e[S].stride,e.skinWeights&&e.skinIndices&&(this.buildGeometryData(p,e.skinIndices,y.offset,h.array),this.buildGeometryData(p,e.skinWeights,y.offset,u.array)),p.hasUV===!1&&t.uvsNeedsFix===!0){let w=(r.array.length-v)/r.stride;for(let E=0;E<w;E++)a.array.push(0,0)}break;case"NORMAL":this.buildGeometryData(p,e[S],y.offset,o.array),o.stride=e[S].stride;break;case"COLOR":this.buildGeometryData(p,e[S],y.offset,c.array,!0),c.stride=e[S].stride;break;case"TEXCOORD":this.buildGeometryData(p,e[S],y.offset,a.array),a.stride=e[S].stride;break;case"TEXCOORD1":this.buildGeometryData(p,e[S],y.offset,l.array),a.stride=e[S].stride;break;default:console.warn('THREE.ColladaLoader: Semantic "%s" not handled in geometry build process.',M)}}break;case"NORMAL":this.buildGeometryData(p,e[y.id],y.offset,o.array),o.stride=e[y.id].stride;break;case"COLOR":this.buildGeometryData(p,e[y.id],y.offset,c.array,!0),c.stride=e[y.id].stride;break;case"TEXCOORD":this.buildGeometryData(p,e[y.id],y.offset,a.array),a.stride=e[y.id].stride;break;case"TEXCOORD1":this.buildGeometryData(p,e[y.id],y.offset,l.array),l.stride=e[y.id].stride;break}}}return r.array.length>0&&d.setAttribute("position",new Ft(r.array,r.stride)),o.array.length>0&&d.setAttribute("normal",new Ft(o.array,o.stride)),c.array.length>0&&d.setAttribute("color",new Ft(c.array,c.stride)),a.array.length>0&&d.setAttribute("uv",new Ft(a.array,a.stride)),l.array.length>0&&d.setAttribute("uv1",new Ft(l.array,l.stride)),h.array.length>0&&d.setAttribute("skinIndex",new Ft(h.array,h.stride)),u.array.length>0&&d.setAttribute("skinWeight",new Ft(u.array,u.stride)),n.data=d,n.type=t[0].type,n.materialKeys=f,n}buildGeometryData(t,e,i,n,r=!1){let o=t.p,a=t.stride,l=t.vcount,c=t.positionSource,h=t.positionOffset,u=this.tempColor;function d(x){let p=o[x+i]*m,g=p+m;for(;p<g;p++)n.push(f[p]);if(r){let _=n.length-m;u.setRGB(n[_+0],n[_+1],n[_+2],oe),n[_+0]=u.r,n[_+1]=u.g,n[_+2]=u.b}}let f=e.array,m=e.stride;if(t.vcount!==void 0){let x=0;for(let p=0,g=l.length;p<g;p++){let _=l[p];if(_===4){let b=x+a*0,y=x+a*1,M=x+a*2,S=x+a*3;d(b),d(y),d(S),d(y),d(M),d(S)}else if(_===3){let b=x+a*0,y=x+a*1,M=x+a*2;d(b),d(y),d(M)}else if(_>4){let b=[];for(let E=0;E<_;E++){let R=x+a*E+h,L=o[R]*c.stride,D=c.array[L],U=c.array[L+1],N=c.array[L+2];b.push(new C(D,U,N))}let y=new C,M=new sn;M.a=b[0],M.b=b[1],M.c=b[2],M.getNormal(y);let S=[];if(Math.abs(y.x)>Math.abs(y.y)&&Math.abs(y.x)>Math.abs(y.z))for(let E=0;E<_;E++)S.push(new Rt(b[E].y,b[E].z));else if(Math.abs(y.y)>Math.abs(y.z))for(let E=0;E<_;E++)S.push(new Rt(b[E].x,b[E].z));else for(let E=0;E<_;E++)S.push(new Rt(b[E].x,b[E].y));let v=xr.isClockWise(S);v===!0&&S.reverse();let w=xr.triangulateShape(S,[]);for(let E=0;E<w.length;E++){let R=w[E],L,D,U;v===!1?(L=R[0],D=R[1],U=R[2]):(L=_-1-R[0],D=_-1-R[2],U=_-1-R[1]);let N=x+a*L,V=x+a*D,k=x+a*U;d(N),d(V),d(k)}}x+=a*_}}else for(let x=0,p=o.length;x<p;x+=a)d(x)}getGeometry(t){return this.getBuild(this.library.geometries[t],this.buildGeometry.bind(this))}buildKinematicsModel(t){return t.build!==void 0?t.build:t}getKinematicsModel(t){return this.getBuild(this.library.kinematicsModels[t],this.buildKinematicsModel.bind(this))}buildKinematicsScene(t){return t.build!==void 0?t.build:t}getKinematicsScene(t){return this.getBuild(this.library.kinematicsScenes[t],this.buildKinematicsScene.bind(this))}setupKinematics(){let t=Object.keys(this.library.kinematicsModels)[0],e=Object.keys(this.library.kinematicsScenes)[0],i=Object.keys(this.library.visualScenes)[0];if(t===void 0||e===void 0)return;let n=this.getKinematicsModel(t),r=this.getKinematicsScene(e),o=this.getVisualScene(i),a=r.bindJointAxis,l={},c=this.collada,h=this;for(let m=0,x=a.length;m<x;m++){let p=a[m],g=c.querySelector('[sid="'+p.target+'"]');if(g){let _=g.parentElement;u(p.jointIndex,_)}}function u(m,x){let p=x.getAttribute("name"),g=n.joints[m],_=h.buildTransformList(x);o.traverse(function(b){b.name===p&&(l[m]={object:b,transforms:_,joint:g,position:g.zeroPosition})})}let d=new wt,f=this.matrix;this.kinematics={joints:n&&n.joints,getJointValue:function(m){let x=l[m];if(x)return x.position;console.warn("THREE.ColladaLoader: Joint "+m+" doesn't exist.")},setJointValue:function(m,x){let p=l[m];if(p){let g=p.joint;if(x>g.limits.max||x<g.limits.min)console.warn("THREE.ColladaLoader: Joint "+m+" value "+x+" outside of limits (min: "+g.limits.min+", max: "+g.limits.max+").");else if(g.static)console.warn("THREE.ColladaLoader: Joint "+m+" is static.");else{let _=p.object,b=g.axis,y=p.transforms;f.identity();for(let M=0;M<y.length;M++){let S=y[M];if(S.sid&&S.sid.indexOf(m)!==-1)switch(g.type){case"revolute":f.multiply(d.makeRotationAxis(b,_i.degToRad(x)));break;case"prismatic":f.multiply(d.makeTranslation(b.x*x,b.y*x,b.z*x));break;default:console.warn("THREE.ColladaLoader: Unknown joint type: "+g.type);break}else switch(S.type){case"matrix":f.multiply(S.obj);break;case"translate":f.multiply(d.makeTranslation(S.obj.x,S.obj.y,S.obj.z));break;case"scale":f.scale(S.obj);break;case"rotate":f.multiply(d.makeRotationAxis(S.obj,S.angle));break}}_.matrix.copy(f),_.matrix.decompose(_.position,_.quaternion,_.scale),l[m].position=x}}else console.warn("THREE.ColladaLoader: Joint "+m+" does not exist.")}}}buildTransformList(t){let e=[],i=this.collada.querySelector('[id="'+t.id+'"]');for(let n=0;n<i.childNodes.length;n++){let r=i.childNodes[n];if(r.nodeType!==1)continue;let o,a;switch(r.nodeName){case"matrix":o=oi(r.textContent);let l=new wt().fromArray(o).transpose();e.push({sid:r.getAttribute("sid"),type:r.nodeName,obj:l});break;case"translate":case"scale":o=oi(r.textContent),a=new C().fromArray(o),e.push({sid:r.getAttribute("sid"),type:r.nodeName,obj:a});break;case"rotate":o=oi(r.textContent),a=new C().fromArray(o);let c=_i.degToRad(o[3]);e.push({sid:r.getAttribute("sid"),type:r.nodeName,obj:a,angle:c});break}}return e}buildSkeleton(t,e){let i=[],n=[],r,o,a;for(r=0;r<t.length;r++){let h=t[r],u;if(this.hasNode(h))u=this.getNode(h),this.buildBoneHierarchy(u,e,i);else if(this.hasVisualScene(h)){let f=this.library.visualScenes[h].children;for(let m=0;m<f.length;m++){let x=f[m];if(x.type==="JOINT"){let p=this.getNode(x.id);this.buildBoneHierarchy(p,e,i)}}}else console.error("THREE.ColladaLoader: Unable to find root bone of skeleton with ID:",h)}for(r=0;r<e.length;r++)for(o=0;o<i.length;o++)if(a=i[o],a.bone.name===e[r].name){n[r]=a,a.processed=!0;break}for(r=0;r<i.length;r++)a=i[r],a.processed===!1&&(n.push(a),a.processed=!0);let l=[],c=[];for(r=0;r<n.length;r++)a=n[r],l.push(a.bone),c.push(a.boneInverse);return new oo(l,c)}buildBoneHierarchy(t,e,i){t.traverse(function(n){if(n.isBone===!0){let r;for(let o=0;o<e.length;o++){let a=e[o];if(a.name===n.name){r=a.boneInverse;break}}r===void 0&&(r=new wt),i.push({bone:n,boneInverse:r,processed:!1})}})}buildNode(t){let e=[],i=t.matrix,n=t.nodes,r=t.type,o=t.instanceCameras,a=t.instanceControllers,l=t.instanceLights,c=t.instanceGeometries,h=t.instanceNodes;for(let d=0,f=n.length;d<f;d++)e.push(this.getNode(n[d]));for(let d=0,f=o.length;d<f;d++){let m=this.getCamera(o[d]);m!==null&&e.push(m.clone())}for(let d=0,f=a.length;d<f;d++){let m=a[d],x=this.getController(m.id),p=this.getGeometry(x.id),g=this.buildObjects(p,m.materials),_=m.skeletons,b=x.skin.joints,y=this.buildSkeleton(_,b);for(let M=0,S=g.length;M<S;M++){let v=g[M];v.isSkinnedMesh&&(v.bind(y,x.skin.bindMatrix),v.normalizeSkinWeights()),e.push(v)}}for(let d=0,f=l.length;d<f;d++){let m=this.getLight(l[d]);m!==null&&e.push(m.clone())}for(let d=0,f=c.length;d<f;d++){let m=c[d],x=this.getGeometry(m.id),p=this.buildObjects(x,m.materials);for(let g=0,_=p.length;g<_;g++)e.push(p[g])}for(let d=0,f=h.length;d<f;d++)e.push(this.getNode(h[d]).clone());let u;if(n.length===0&&e.length===1)u=e[0];else{u=r==="JOINT"?new mr:new Kt;for(let d=0;d<e.length;d++)u.add(e[d])}return u.name=r==="JOINT"?t.sid:t.name,r!=="JOINT"&&this.hasPivotTransforms(t)?this.wrapWithTransformHierarchy(u,t):(u.matrix.copy(i),u.matrix.decompose(u.position,u.quaternion,u.scale),u)}wrapWithTransformHierarchy(t,e){let i=e.id;this.transformNodes[i]={};let n=e.transformOrder,r=e.transformData,o=new Kt;o.name=e.name;let a=o;for(let l=0;l<n.length;l++){let c=n[l],h=r[c],u=new Kt;switch(u.name=e.name+"_"+c,h.type){case"translate":u.position.set(h.x,h.y,h.z);break;case"rotate":{let d=new C(h.axis[0],h.axis[1],h.axis[2]),f=_i.degToRad(h.angle);u.quaternion.setFromAxisAngle(d,f),u.userData.rotationAxis=d;break}case"scale":u.scale.set(h.x,h.y,h.z);break;case"matrix":{new wt().fromArray(h.array).transpose().decompose(u.position,u.quaternion,u.scale);break}}this.transformNodes[i][c]=u,a.add(u),a=u}return a.add(t),o}resolveMaterialBinding(t,e){let i=[];for(let n=0,r=t.length;n<r;n++){let o=e[t[n]];o===void 0?(console.warn("THREE.ColladaLoader: Material with key %s not found. Apply fallback material.",t[n]),i.push(this.fallbackMaterial)):i.push(this.getMaterial(o))}return i}get fallbackMaterial(){return this._fallbackMaterial===void 0&&(this._fallbackMaterial=new ti({name:ni.DEFAULT_MATERIAL_NAME,color:16711935})),this._fallbackMaterial}buildObjects(t,e){let i=[];for(let n in t){let r=t[n],o=this.resolveMaterialBinding(r.materialKeys,e);if(o.length===0&&(n==="lines"||n==="linestrips"?o.push(new ei):o.push(new gi)),n==="lines"||n==="linestrips")for(let h=0,u=o.length;h<u;h++){let d=o[h];if(d.isMeshPhongMaterial===!0||d.isMeshLambertMaterial===!0){let f=new ei;f.color.copy(d.color),f.opacity=d.opacity,f.transparent=d.transparent,o[h]=f}}let a=r.data.attributes.skinIndex!==void 0,l=o.length===1?o[0]:o,c;switch(n){case"lines":c=new An(r.data,l);break;case"linestrips":c=new Ge(r.data,l);break;case"triangles":case"polygons":case"polylist":a?c=new ro(r.data,l):c=new st(r.data,l);break}i.push(c)}return i}hasNode(t){return this.library.nodes[t]!==void 0}getNode(t){return this.getBuild(this.library.nodes[t],this.buildNode.bind(this))}buildVisualScene(t){let e=new Kt;e.name=t.name;let i=t.children;for(let n=0;n<i.length;n++){let r=i[n];e.add(this.getNode(r.id))}return e}hasVisualScene(t){return this.library.visualScenes[t]!==void 0}getVisualScene(t){return this.getBuild(this.library.visualScenes[t],this.buildVisualScene.bind(this))}parseScene(t){let e=vi(t,"instance_visual_scene")[0];return this.getVisualScene(this.parseId(e.getAttribute("url")))}parseId(t){return t.substring(1)}setupAnimations(){let t=this.library.clips;if(this.isEmpty(t)===!0){if(this.isEmpty(this.library.animations)===!1){let e=[];for(let i in this.library.animations){let n=this.getAnimation(i);for(let r=0,o=n.length;r<o;r++)e.push(n[r])}this.buildDeferredPivotAnimationTracks(e),this.animations.push(new _r("default",-1,e))}}else for(let e in t)this.animations.push(this.getAnimationClip(e))}buildDeferredPivotAnimationTracks(t){for(let e in this.deferredPivotAnimations){let i=this.library.nodes[e];if(!i)continue;let n=this.deferredPivotAnimations[e];this.buildTransformHierarchyTracks(e,n,i,t)}}buildTransformHierarchyTracks(t,e,i,n){let r=this.transformNodes[t];if(!r){console.warn("THREE.ColladaLoader: Transform hierarchy not found for node:",t);return}for(let o in e){let a=r[o];if(!a)continue;let l=i.transforms[o],c=i.transformData[o],h=e[o];switch(l){case"translate":this.buildHierarchyTranslateTrack(a,h,c,n);break;case"rotate":this.buildHierarchyRotateTrack(a,h,c,n);break;case"scale":this.buildHierarchyScaleTrack(a,h,c,n);break}}}buildHierarchyTranslateTrack(t,e,i,n){if(e.default&&e.default.stride===3){let c=e.default,h=new ii(t.uuid+".position",Array.from(c.times),Array.from(c.values)),u=this.getInterpolationInfo(e);this.applyInterpolation(h,u,e),n.push(h);return}let r=this.getTimesForAllAxes(e);if(r.length===0)return;let o=[],a=this.getInterpolationInfo(e);for(let c=0;c<r.length;c++){let h=r[c],u=this.getValueAtTime(e.X,h,i.x),d=this.getValueAtTime(e.Y,h,i.y),f=this.getValueAtTime(e.Z,h,i.z);o.push(u,d,f)}let l=new ii(t.uuid+".position",r,o);this.applyInterpolation(l,a),n.push(l)}buildHierarchyRotateTrack(t,e,i,n){let r=e.ANGLE||e.default;if(!r)return;let o=Array.from(r.times);if(o.length===0)return;let a=t.userData.rotationAxis||new C(i.axis[0],i.axis[1],i.axis[2]),l=new Wt,c=new Wt,h=[],u=this.getInterpolationInfo(e);for(let f=0;f<o.length;f++){let m=o[f],x=this.getValueAtTime(r,m,i.angle),p=_i.degToRad(x);l.setFromAxisAngle(a,p),f>0&&c.dot(l)<0&&(l.x=-l.x,l.y=-l.y,l.z=-l.z,l.w=-l.w),c.copy(l),h.push(l.x,l.y,l.z,l.w)}let d=new ln(t.uuid+".quaternion",o,h);this.applyInterpolation(d,u),n.push(d)}buildHierarchyScaleTrack(t,e,i,n){if(e.default&&e.default.stride===3){let c=e.default,h=new ii(t.uuid+".scale",Array.from(c.times),Array.from(c.values)),u=this.getInterpolationInfo(e);this.applyInterpolation(h,u,e),n.push(h);return}let r=this.getTimesForAllAxes(e);if(r.length===0)return;let o=[],a=this.getInterpolationInfo(e);for(let c=0;c<r.length;c++){let h=r[c],u=this.getValueAtTime(e.X,h,i.x),d=this.getValueAtTime(e.Y,h,i.y),f=this.getValueAtTime(e.Z,h,i.z);o.push(u,d,f)}let l=new ii(t.uuid+".scale",r,o);this.applyInterpolation(l,a),n.push(l)}};var Lr=class extends ni{load(t,e,i,n){let r=this,o=r.path===""?Rs.extractUrlBase(t):r.path,a=new zi(r.manager);a.setPriority(r.priority),a.setCache(r.cache),a.setPath(r.path),a.setRequestHeader(r.requestHeader),a.setWithCredentials(r.withCredentials),a.load(t,function(l){try{e(r.parse(l,o))}catch(c){n?n(c):console.error(c),r.manager.itemError(t)}},i,n)}parse(t,e){if(t.length===0)return{scene:new _s};let n=new ic().parse(t);if(n===null)return null;let{library:r,asset:o,collada:a}=n,l=new Ts(this.manager);l.setPriority(this.priority),l.setCache(this.cache),l.setPath(this.resourcePath||e).setCrossOrigin(this.crossOrigin);let c;Uo&&(c=new Uo(this.manager),c.setPriority(this.priority),c.setCache(this.cache),c.setPath(this.resourcePath||e),c.setRequestHeader(this.requestHeader),c.setWithCredentials(this.withCredentials));let h=new nc(r,a,l,c),{scene:u,animations:d,kinematics:f}=h.compose();return u.animations=d,o.upAxis==="Z_UP"&&(console.warn("THREE.ColladaLoader: You are loading an asset with a Z-UP coordinate system. The loader just rotates the asset to transform it into Y-UP. The vertex data are not converted, see #24289."),u.rotation.set(-Math.PI/2,0,0)),u.scale.multiplyScalar(o.unit),{get animations(){return console.warn("THREE.ColladaLoader: Please access animations over scene.animations now."),d},kinematics:f,library:r,scene:u}}};var Kp=new C,uS=new Qe,sc=new wt,es=new wt,rc=new Wt,oc=new C(1,1,1),ac=new C,Nr=class extends te{constructor(...t){super(...t),this.urdfNode=null,this.urdfName=""}copy(t,e){return super.copy(t,e),this.urdfNode=t.urdfNode,this.urdfName=t.urdfName,this}},lc=class extends Nr{constructor(...t){super(...t),this.isURDFCollider=!0,this.type="URDFCollider"}},cc=class extends Nr{constructor(...t){super(...t),this.isURDFVisual=!0,this.type="URDFVisual"}},Bo=class extends Nr{constructor(...t){super(...t),this.isURDFLink=!0,this.type="URDFLink",this.name="",this.inertial={mass:0,origin:{xyz:[0,0,0],rpy:[0,0,0]},inertia:{ixx:0,ixy:0,ixz:0,iyy:0,iyz:0,izz:0}}}copy(t,e){return super.copy(t,e),this.inertial={mass:t.inertial.mass,origin:{xyz:[...t.inertial.origin.xyz],rpy:[...t.inertial.origin.rpy]},inertia:{...t.inertial.inertia}},this}},is=class extends Nr{get jointType(){return this._jointType}set jointType(t){if(this.jointType!==t)switch(this._jointType=t,this.matrixWorldNeedsUpdate=!0,t){case"fixed":this.jointValue=[];break;case"continuous":case"revolute":case"prismatic":this.jointValue=new Array(1).fill(0);break;case"planar":this.jointValue=new Array(3).fill(0),this.axis=new C(0,0,1);break;case"floating":this.jointValue=new Array(6).fill(0);break}}get angle(){return this.jointValue[0]}constructor(...t){super(...t),this.isURDFJoint=!0,this.type="URDFJoint",this.name="",this.jointValue=null,this.jointType="fixed",this.axis=new C(1,0,0),this.limit={lower:0,upper:0,effort:0,velocity:0},this.ignoreLimits=!1,this.origPosition=null,this.origQuaternion=null,this.mimicJoints=[]}copy(t,e){return super.copy(t,e),this.jointType=t.jointType,this.axis=t.axis.clone(),this.limit.lower=t.limit.lower,this.limit.upper=t.limit.upper,this.limit.effort=t.limit.effort,this.limit.velocity=t.limit.velocity,this.ignoreLimits=!1,this.jointValue=[...t.jointValue],this.origPosition=t.origPosition?t.origPosition.clone():null,this.origQuaternion=t.origQuaternion?t.origQuaternion.clone():null,this.mimicJoints=[...t.mimicJoints],this}setJointValue(...t){t=t.map(i=>i===null?null:parseFloat(i)),(!this.origPosition||!this.origQuaternion)&&(this.origPosition=this.position.clone(),this.origQuaternion=this.quaternion.clone());let e=!1;switch(this.mimicJoints.forEach(i=>{e=i.updateFromMimickedJoint(...t)||e}),this.jointType){case"fixed":return e;case"continuous":case"revolute":{let i=t[0];return i==null||i===this.jointValue[0]?e:(!this.ignoreLimits&&this.jointType==="revolute"&&(i=Math.min(this.limit.upper,i),i=Math.max(this.limit.lower,i)),this.quaternion.setFromAxisAngle(this.axis,i).premultiply(this.origQuaternion),this.jointValue[0]!==i?(this.jointValue[0]=i,this.matrixWorldNeedsUpdate=!0,!0):e)}case"prismatic":{let i=t[0];return i==null||i===this.jointValue[0]?e:(this.ignoreLimits||(i=Math.min(this.limit.upper,i),i=Math.max(this.limit.lower,i)),this.position.copy(this.origPosition),Kp.copy(this.axis).applyEuler(this.rotation),this.position.addScaledVector(Kp,i),this.jointValue[0]!==i?(this.jointValue[0]=i,this.matrixWorldNeedsUpdate=!0,!0):e)}case"floating":return this.jointValue.every((i,n)=>t[n]===i||t[n]===null)?e:(this.jointValue[0]=t[0]!==null?t[0]:this.jointValue[0],this.jointValue[1]=t[1]!==null?t[1]:this.jointValue[1],this.jointValue[2]=t[2]!==null?t[2]:this.jointValue[2],this.jointValue[3]=t[3]!==null?t[3]:this.jointValue[3],this.jointValue[4]=t[4]!==null?t[4]:this.jointValue[4],this.jointValue[5]=t[5]!==null?t[5]:this.jointValue[5],es.compose(this.origPosition,this.origQuaternion,oc),rc.setFromEuler(uS.set(this.jointValue[3],this.jointValue[4],this.jointValue[5],"XYZ")),ac.set(this.jointValue[0],this.jointValue[1],this.jointValue[2]),sc.compose(ac,rc,oc),es.premultiply(sc),this.position.setFromMatrixPosition(es),this.rotation.setFromRotationMatrix(es),this.matrixWorldNeedsUpdate=!0,!0);case"planar":return this.jointValue.every((i,n)=>t[n]===i||t[n]===null)?e:(this.jointValue[0]=t[0]!==null?t[0]:this.jointValue[0],this.jointValue[1]=t[1]!==null?t[1]:this.jointValue[1],this.jointValue[2]=t[2]!==null?t[2]:this.jointValue[2],es.compose(this.origPosition,this.origQuaternion,oc),rc.setFromAxisAngle(this.axis,this.jointValue[2]),ac.set(this.jointValue[0],this.jointValue[1],0),sc.compose(ac,rc,oc),es.premultiply(sc),this.position.setFromMatrixPosition(es),this.rotation.setFromRotationMatrix(es),this.matrixWorldNeedsUpdate=!0,!0)}return e}},Vo=class extends is{constructor(...t){super(...t),this.type="URDFMimicJoint",this.mimicJoint=null,this.offset=0,this.multiplier=1}updateFromMimickedJoint(...t){let e=t.map(i=>i===null?null:i*this.multiplier+this.offset);return super.setJointValue(...e)}copy(t,e){return super.copy(t,e),this.mimicJoint=t.mimicJoint,this.offset=t.offset,this.multiplier=t.multiplier,this}},hc=class extends Bo{constructor(...t){super(...t),this.isURDFRobot=!0,this.urdfNode=null,this.urdfRobotNode=null,this.robotName=null,this.links=null,this.joints=null,this.colliders=null,this.visual=null,this.frames=null}copy(t,e){super.copy(t,e),this.urdfRobotNode=t.urdfRobotNode,this.robotName=t.robotName,this.links={},this.joints={},this.colliders={},this.visual={},this.traverse(i=>{i.isURDFJoint&&i.urdfName in t.joints&&(this.joints[i.urdfName]=i),i.isURDFLink&&i.urdfName in t.links&&(this.links[i.urdfName]=i),i.isURDFCollider&&i.urdfName in t.colliders&&(this.colliders[i.urdfName]=i),i.isURDFVisual&&i.urdfName in t.visual&&(this.visual[i.urdfName]=i)});for(let i in this.joints)this.joints[i].mimicJoints=this.joints[i].mimicJoints.map(n=>this.joints[n.name]);return this.frames={...this.colliders,...this.visual,...this.links,...this.joints},this}getFrame(t){return this.frames[t]}setJointValue(t,...e){let i=this.joints[t];return i?i.setJointValue(...e):!1}setJointValues(t){let e=!1;for(let i in t){let n=t[i];Array.isArray(n)?e=this.setJointValue(i,...n)||e:e=this.setJointValue(i,n)||e}return e}};var Vu=new Wt,Qp=new Qe;function ns(s){return s?s.trim().split(/\s+/g).map(t=>parseFloat(t)):[0,0,0]}function tm(s,t,e=!1){e||s.rotation.set(0,0,0),Qp.set(t[0],t[1],t[2],"ZYX"),Vu.setFromEuler(Qp),Vu.multiply(s.quaternion),s.quaternion.copy(Vu)}var Hu=class{constructor(t){this.manager=t||Xl,this.loadMeshCb=this.defaultMeshLoader.bind(this),this.parseVisual=!0,this.parseCollision=!1,this.packages="",this.workingPath="",this.fetchOptions={}}loadAsync(t){return new Promise((e,i)=>{this.load(t,e,null,i)})}load(t,e,i,n){let r=this.manager,o=Rs.extractUrlBase(t),a=this.manager.resolveURL(t);r.itemStart(a),fetch(a,this.fetchOptions).then(l=>{if(l.ok)return i&&i(null),l.text();throw new Error(`URDFLoader: Failed to load url '${a}' with error code ${l.status} : ${l.statusText}.`)}).then(l=>{let c=this.parse(l,this.workingPath||o);e(c),r.itemEnd(a)}).catch(l=>{n?n(l):console.error("URDFLoader: Error loading file.",l),r.itemError(a),r.itemEnd(a)})}parse(t,e=this.workingPath){let i=this.packages,n=this.loadMeshCb,r=this.parseVisual,o=this.parseCollision,a=this.manager,l={},c={},h={};function u(_){if(!/^package:\/\//.test(_))return e?e+_:_;let[b,y]=_.replace(/^package:\/\//,"").split(/\/(.+)/);if(typeof i=="string")return i.endsWith(b)?i+"/"+y:i+"/"+b+"/"+y;if(typeof i=="function")return i(b)+"/"+y;if(typeof i=="object")return b in i?i[b]+"/"+y:(console.error(`URDFLoader : ${b} not found in provided package list.`),null)}function d(_){let b;_ instanceof Document?b=[..._.children]:_ instanceof Element?b=[_]:b=[...new DOMParser().parseFromString(_,"text/xml").children];let y=b.filter(M=>M.nodeName==="robot").pop();return f(y)}function f(_){let b=[..._.children],y=b.filter(L=>L.nodeName.toLowerCase()==="link"),M=b.filter(L=>L.nodeName.toLowerCase()==="joint"),S=b.filter(L=>L.nodeName.toLowerCase()==="material"),v=new hc;v.robotName=_.getAttribute("name"),v.urdfRobotNode=_,S.forEach(L=>{let D=L.getAttribute("name");h[D]=p(L)});let w={},E={};y.forEach(L=>{let D=L.getAttribute("name"),U=_.querySelector(`child[link="${D}"]`)===null;l[D]=x(L,w,E,U?v:null)}),M.forEach(L=>{let D=L.getAttribute("name");c[D]=m(L)}),v.joints=c,v.links=l,v.colliders=E,v.visual=w;let R=Object.values(c);return R.forEach(L=>{L instanceof Vo&&c[L.mimicJoint].mimicJoints.push(L)}),R.forEach(L=>{let D=new Set,U=N=>{if(D.has(N))throw new Error("URDFLoader: Detected an infinite loop of mimic joints.");D.add(N),N.mimicJoints.forEach(V=>{U(V)})};U(L)}),v.frames={...E,...w,...l,...c},v}function m(_){let b=[..._.children],y=_.getAttribute("type"),M,S=b.find(D=>D.nodeName.toLowerCase()==="mimic");S?(M=new Vo,M.mimicJoint=S.getAttribute("joint"),M.multiplier=parseFloat(S.getAttribute("multiplier")||1),M.offset=parseFloat(S.getAttribute("offset")||0)):M=new is,M.urdfNode=_,M.name=_.getAttribute("name"),M.urdfName=M.name,M.jointType=y;let v=null,w=null,E=[0,0,0],R=[0,0,0];b.forEach(D=>{let U=D.nodeName.toLowerCase();U==="origin"?(E=ns(D.getAttribute("xyz")),R=ns(D.getAttribute("rpy"))):U==="child"?w=l[D.getAttribute("link")]:U==="parent"?v=l[D.getAttribute("link")]:U==="limit"&&(M.limit.lower=parseFloat(D.getAttribute("lower")||M.limit.lower),M.limit.upper=parseFloat(D.getAttribute("upper")||M.limit.upper),M.limit.effort=parseFloat(D.getAttribute("effort")||M.limit.effort),M.limit.velocity=parseFloat(D.getAttribute("velocity")||M.limit.velocity))}),v.add(M),M.add(w),tm(M,R),M.position.set(E[0],E[1],E[2]);let L=b.filter(D=>D.nodeName.toLowerCase()==="axis")[0];if(L){let D=L.getAttribute("xyz").split(/\s+/g).map(U=>parseFloat(U));M.axis=new C(D[0],D[1],D[2]),M.axis.normalize()}return M}function x(_,b,y,M=null){M===null&&(M=new Bo);let S=[..._.children];M.name=_.getAttribute("name"),M.urdfName=M.name,M.urdfNode=_;let v=S.find(w=>w.nodeName.toLowerCase()==="inertial");return v&&[...v.children].forEach(w=>{let E=w.nodeName.toLowerCase();E==="origin"?(M.inertial.origin.xyz=ns(w.getAttribute("xyz")),M.inertial.origin.rpy=ns(w.getAttribute("rpy"))):E==="mass"?M.inertial.mass=parseFloat(w.getAttribute("value"))||0:E==="inertia"&&(M.inertial.inertia.ixx=parseFloat(w.getAttribute("ixx"))||0,M.inertial.inertia.ixy=parseFloat(w.getAttribute("ixy"))||0,M.inertial.inertia.ixz=parseFloat(w.getAttribute("ixz"))||0,M.inertial.inertia.iyy=parseFloat(w.getAttribute("iyy"))||0,M.inertial.inertia.iyz=parseFloat(w.getAttribute("iyz"))||0,M.inertial.inertia.izz=parseFloat(w.getAttribute("izz"))||0)}),r&&S.filter(E=>E.nodeName.toLowerCase()==="visual").forEach(E=>{let R=g(E,h);if(M.add(R),E.hasAttribute("name")){let L=E.getAttribute("name");R.name=L,R.urdfName=L,b[L]=R}}),o&&S.filter(E=>E.nodeName.toLowerCase()==="collision").forEach(E=>{let R=g(E);if(M.add(R),E.hasAttribute("name")){let L=E.getAttribute("name");R.name=L,R.urdfName=L,y[L]=R}}),M}function p(_){let b=[..._.children],y=new gi;return y.name=_.getAttribute("name")||"",b.forEach(M=>{let S=M.nodeName.toLowerCase();if(S==="color"){let v=M.getAttribute("rgba").split(/\s/g).map(w=>parseFloat(w));y.color.setRGB(v[0],v[1],v[2]),y.opacity=v[3],y.transparent=v[3]<1,y.depthWrite=!y.transparent}else if(S==="texture"){let v=M.getAttribute("filename");if(v){let w=new Ts(a),E=u(v);y.map=w.load(E),y.map.colorSpace=oe}}}),y}function g(_,b={}){let y=_.nodeName.toLowerCase()==="collision",M=[..._.children],S=null,v=M.filter(E=>E.nodeName.toLowerCase()==="material")[0];if(v){let E=v.getAttribute("name");E&&E in b?S=b[E]:S=p(v)}else S=new gi;let w=y?new lc:new cc;return w.urdfNode=_,M.forEach(E=>{let R=E.nodeName.toLowerCase();if(R==="geometry"){let L=E.children[0].nodeName.toLowerCase();if(L==="mesh"){let D=E.children[0].getAttribute("filename"),U=u(D);if(U!==null){let N=E.children[0].getAttribute("scale");if(N){let V=ns(N);w.scale.set(V[0],V[1],V[2])}n(U,a,S,(V,k)=>{k?console.error("URDFLoader: Error loading mesh.",k):V&&(V.position.set(0,0,0),V.quaternion.identity(),w.add(V))})}}else if(L==="box"){let D=new st;D.geometry=new ye(1,1,1),D.material=S;let U=ns(E.children[0].getAttribute("size"));D.scale.set(U[0],U[1],U[2]),w.add(D)}else if(L==="sphere"){let D=new st;D.geometry=new Cn(1,30,30),D.material=S;let U=parseFloat(E.children[0].getAttribute("radius"))||0;D.scale.set(U,U,U),w.add(D)}else if(L==="cylinder"){let D=new st;D.geometry=new Me(1,1,1,30),D.material=S;let U=parseFloat(E.children[0].getAttribute("radius"))||0,N=parseFloat(E.children[0].getAttribute("length"))||0;D.scale.set(U,N,U),D.rotation.set(Math.PI/2,0,0),w.add(D)}}else if(R==="origin"){let L=ns(E.getAttribute("xyz")),D=ns(E.getAttribute("rpy"));w.position.set(L[0],L[1],L[2]),w.rotation.set(0,0,0),tm(w,D)}}),w}return d(t)}defaultMeshLoader(t,e,i,n){/\.stl$/i.test(t)?new Ir(e).load(t,o=>{let a=new st(o,i||new gi);n(a)},null,o=>n(null,o)):/\.dae$/i.test(t)?new Lr(e).load(t,o=>n(o.scene),null,o=>n(null,o)):console.warn(`URDFLoader: Could not load model at ${t}.
No loader available`)}},em=Hu;var dS=/^[og]\s*(.+)?/,fS=/^mtllib /,pS=/^usemtl /,mS=/^usemap /,uc=/\s+/,im=new C,Gu=new C,nm=new C,sm=new C,Ui=new C,dc=new It;function gS(){let s={objects:[],object:{},vertices:[],normals:[],colors:[],uvs:[],materials:{},materialLibraries:[],startObject:function(t,e){if(this.object&&this.object.fromDeclaration===!1){this.object.name=t,this.object.fromDeclaration=e!==!1;return}let i=this.object&&typeof this.object.currentMaterial=="function"?this.object.currentMaterial():void 0;if(this.object&&typeof this.object._finalize=="function"&&this.object._finalize(!0),this.object={name:t||"",fromDeclaration:e!==!1,geometry:{vertices:[],normals:[],colors:[],uvs:[],hasUVIndices:!1},materials:[],smooth:!0,startMaterial:function(n,r){let o=this._finalize(!1);o&&(o.inherited||o.groupCount<=0)&&this.materials.splice(o.index,1);let a={index:this.materials.length,name:n||"",mtllib:Array.isArray(r)&&r.length>0?r[r.length-1]:"",smooth:o!==void 0?o.smooth:this.smooth,groupStart:o!==void 0?o.groupEnd:0,groupEnd:-1,groupCount:-1,inherited:!1,clone:function(l){let c={index:typeof l=="number"?l:this.index,name:this.name,mtllib:this.mtllib,smooth:this.smooth,groupStart:0,groupEnd:-1,groupCount:-1,inherited:!1};return c.clone=this.clone.bind(c),c}};return this.materials.push(a),a},currentMaterial:function(){if(this.materials.length>0)return this.materials[this.materials.length-1]},_finalize:function(n){let r=this.currentMaterial();if(r&&r.groupEnd===-1&&(r.groupEnd=this.geometry.vertices.length/3,r.groupCount=r.groupEnd-r.groupStart,r.inherited=!1),n&&this.materials.length>1)for(let o=this.materials.length-1;o>=0;o--)this.materials[o].groupCount<=0&&this.materials.splice(o,1);return n&&this.materials.length===0&&this.materials.push({name:"",smooth:this.smooth}),r}},i&&i.name&&typeof i.clone=="function"){let n=i.clone(0);n.inherited=!0,this.object.materials.push(n)}this.objects.push(this.object)},finalize:function(){this.object&&typeof this.object._finalize=="function"&&this.object._finalize(!0)},parseVertexIndex:function(t,e){let i=parseInt(t,10);return(i>=0?i-1:i+e/3)*3},parseNormalIndex:function(t,e){let i=parseInt(t,10);return(i>=0?i-1:i+e/3)*3},parseUVIndex:function(t,e){let i=parseInt(t,10);return(i>=0?i-1:i+e/2)*2},addVertex:function(t,e,i){let n=this.vertices,r=this.object.geometry.vertices;r.push(n[t+0],n[t+1],n[t+2]),r.push(n[e+0],n[e+1],n[e+2]),r.push(n[i+0],n[i+1],n[i+2])},addVertexPoint:function(t){let e=this.vertices;this.object.geometry.vertices.push(e[t+0],e[t+1],e[t+2])},addVertexLine:function(t){let e=this.vertices;this.object.geometry.vertices.push(e[t+0],e[t+1],e[t+2])},addNormal:function(t,e,i){let n=this.normals,r=this.object.geometry.normals;r.push(n[t+0],n[t+1],n[t+2]),r.push(n[e+0],n[e+1],n[e+2]),r.push(n[i+0],n[i+1],n[i+2])},addFaceNormal:function(t,e,i){let n=this.vertices,r=this.object.geometry.normals;im.fromArray(n,t),Gu.fromArray(n,e),nm.fromArray(n,i),Ui.subVectors(nm,Gu),sm.subVectors(im,Gu),Ui.cross(sm),Ui.normalize(),r.push(Ui.x,Ui.y,Ui.z),r.push(Ui.x,Ui.y,Ui.z),r.push(Ui.x,Ui.y,Ui.z)},addColor:function(t,e,i){let n=this.colors,r=this.object.geometry.colors;n[t]!==void 0&&r.push(n[t+0],n[t+1],n[t+2]),n[e]!==void 0&&r.push(n[e+0],n[e+1],n[e+2]),n[i]!==void 0&&r.push(n[i+0],n[i+1],n[i+2])},addUV:function(t,e,i){let n=this.uvs,r=this.object.geometry.uvs;r.push(n[t+0],n[t+1]),r.push(n[e+0],n[e+1]),r.push(n[i+0],n[i+1])},addDefaultUV:function(){let t=this.object.geometry.uvs;t.push(0,0),t.push(0,0),t.push(0,0)},addUVLine:function(t){let e=this.uvs;this.object.geometry.uvs.push(e[t+0],e[t+1])},addFace:function(t,e,i,n,r,o,a,l,c){let h=this.vertices.length,u=this.parseVertexIndex(t,h),d=this.parseVertexIndex(e,h),f=this.parseVertexIndex(i,h);if(this.addVertex(u,d,f),this.addColor(u,d,f),a!==void 0&&a!==""){let m=this.normals.length;u=this.parseNormalIndex(a,m),d=this.parseNormalIndex(l,m),f=this.parseNormalIndex(c,m),this.addNormal(u,d,f)}else this.addFaceNormal(u,d,f);if(n!==void 0&&n!==""){let m=this.uvs.length;u=this.parseUVIndex(n,m),d=this.parseUVIndex(r,m),f=this.parseUVIndex(o,m),this.addUV(u,d,f),this.object.geometry.hasUVIndices=!0}else this.addDefaultUV()},addPointGeometry:function(t){this.object.geometry.type="Points";let e=this.vertices.length;for(let i=0,n=t.length;i<n;i++){let r=this.parseVertexIndex(t[i],e);this.addVertexPoint(r),this.addColor(r)}},addLineGeometry:function(t,e){this.object.geometry.type="Line";let i=this.vertices.length,n=this.uvs.length;for(let r=0,o=t.length-1;r<o;r++)this.addVertexLine(this.parseVertexIndex(t[r],i)),this.addVertexLine(this.parseVertexIndex(t[r+1],i));for(let r=0,o=e.length-1;r<o;r++)this.addUVLine(this.parseUVIndex(e[r],n)),this.addUVLine(this.parseUVIndex(e[r+1],n))}};return s.startObject("",!1),s}var fc=class extends ni{constructor(t){super(t),this.materials=null}load(t,e,i,n){let r=this,o=new zi(this.manager);o.setPriority(this.priority),o.setCache(this.cache),o.setPath(this.path),o.setRequestHeader(this.requestHeader),o.setWithCredentials(this.withCredentials),o.load(t,function(a){try{e(r.parse(a))}catch(l){n?n(l):console.error(l),r.manager.itemError(t)}},i,n)}setMaterials(t){return this.materials=t,this}parse(t){let e=new gS;t.indexOf(`\r
`)!==-1&&(t=t.replace(/\r\n/g,`
`)),t.indexOf(`\\
`)!==-1&&(t=t.replace(/\\\n/g,""));let i=t.split(`
`),n=[];for(let a=0,l=i.length;a<l;a++){let c=i[a].trimStart();if(c.length===0)continue;let h=c.charAt(0);if(h!=="#")if(h==="v"){let u=c.split(uc);switch(u[0]){case"v":e.vertices.push(parseFloat(u[1]),parseFloat(u[2]),parseFloat(u[3])),u.length>=7?(dc.setRGB(parseFloat(u[4]),parseFloat(u[5]),parseFloat(u[6]),oe),e.colors.push(dc.r,dc.g,dc.b)):e.colors.push(void 0,void 0,void 0);break;case"vn":e.normals.push(parseFloat(u[1]),parseFloat(u[2]),parseFloat(u[3]));break;case"vt":e.uvs.push(parseFloat(u[1]),parseFloat(u[2]));break}}else if(h==="f"){let d=c.slice(1).trim().split(uc),f=[];for(let x=0,p=d.length;x<p;x++){let g=d[x];if(g.length>0){let _=g.split("/");f.push(_)}}let m=f[0];for(let x=1,p=f.length-1;x<p;x++){let g=f[x],_=f[x+1];e.addFace(m[0],g[0],_[0],m[1],g[1],_[1],m[2],g[2],_[2])}}else if(h==="l"){let u=c.substring(1).trim().split(uc),d=[],f=[];if(c.indexOf("/")===-1)d=u;else for(let m=0,x=u.length;m<x;m++){let p=u[m].split("/");p[0]!==""&&d.push(p[0]),p[1]!==""&&f.push(p[1])}e.addLineGeometry(d,f)}else if(h==="p"){let d=c.slice(1).trim().split(uc);e.addPointGeometry(d)}else if((n=dS.exec(c))!==null){let u=(" "+n[0].slice(1).trim()).slice(1);e.startObject(u)}else if(pS.test(c))e.object.startMaterial(c.substring(7).trim(),e.materialLibraries);else if(fS.test(c))e.materialLibraries.push(c.substring(7).trim());else if(mS.test(c))console.warn('THREE.OBJLoader: Rendering identifier "usemap" not supported. Textures must be defined in MTL files.');else if(h==="s"){if(n=c.split(" "),n.length>1){let d=n[1].trim().toLowerCase();e.object.smooth=d!=="0"&&d!=="off"}else e.object.smooth=!0;let u=e.object.currentMaterial();u&&(u.smooth=e.object.smooth)}else{if(c==="\0")continue;console.warn('THREE.OBJLoader: Unexpected line: "'+c+'"')}}e.finalize();let r=new Kt;if(r.materialLibraries=[].concat(e.materialLibraries),!(e.objects.length===1&&e.objects[0].geometry.vertices.length===0)===!0)for(let a=0,l=e.objects.length;a<l;a++){let c=e.objects[a],h=c.geometry,u=c.materials,d=h.type==="Line",f=h.type==="Points",m=!1;if(h.vertices.length===0)continue;let x=new ce;x.setAttribute("position",new Ft(h.vertices,3)),h.normals.length>0&&x.setAttribute("normal",new Ft(h.normals,3)),h.colors.length>0&&(m=!0,x.setAttribute("color",new Ft(h.colors,3))),h.hasUVIndices===!0&&x.setAttribute("uv",new Ft(h.uvs,2));let p=[];for(let _=0,b=u.length;_<b;_++){let y=u[_],M=y.name+"_"+y.smooth+"_"+m,S=e.materials[M];if(this.materials!==null){if(S=this.materials.create(y.name),d&&S&&!(S instanceof ei)){let v=new ei;mi.prototype.copy.call(v,S),v.color.copy(S.color),S=v}else if(f&&S&&!(S instanceof En)){let v=new En({size:10,sizeAttenuation:!1});mi.prototype.copy.call(v,S),v.color.copy(S.color),v.map=S.map,S=v}}S===void 0&&(d?S=new ei:f?S=new En({size:1,sizeAttenuation:!1}):S=new gi,S.name=y.name,S.flatShading=!y.smooth,S.vertexColors=m,e.materials[M]=S),p.push(S)}let g;if(p.length>1){for(let _=0,b=u.length;_<b;_++){let y=u[_];x.addGroup(y.groupStart,y.groupCount,_)}d?g=new An(x,p):f?g=new bs(x,p):g=new st(x,p)}else d?g=new An(x,p[0]):f?g=new bs(x,p[0]):g=new st(x,p[0]);g.name=c.name,r.add(g)}else if(e.vertices.length>0){let a=new En({size:1,sizeAttenuation:!1}),l=new ce;l.setAttribute("position",new Ft(e.vertices,3)),e.colors.length>0&&e.colors[0]!==void 0&&(l.setAttribute("color",new Ft(e.colors,3)),a.vertexColors=!0);let c=new bs(l,a);r.add(c)}return r}};var xS=new It(16777215);function rm(s){let t=new Map;return async(e,i)=>{let n=t.get(e)??yS(s(e),e);return t.set(e,n),bS((await n).clone(!0),e,i)}}async function yS(s,t){let e=new jn;switch(t.split(".").pop()?.toLowerCase()){case"stl":return new st(await new Ir(e).loadAsync(s));case"obj":return new fc(e).loadAsync(s);case"dae":{let i=new Lr(e).parse(_S(await new zi(e).loadAsync(s)),vS(s));if(!i)throw new Error("no Collada document");for(let n of SS(i.scene))n.removeFromParent();return i.scene}default:throw new Error("no reader for this kind of file")}}function _S(s){return String(s).replace(/<up_axis>[^<]*<\/up_axis>/,"")}function vS(s){return s.slice(0,s.lastIndexOf("/")+1)}function bS(s,t,e){return/\.dae$/i.test(t)||s.traverse(i=>{i instanceof st&&(i.material=e)}),s}function SS(s){let t=[];return s.traverse(e=>{(e.isLight||e.isCamera)&&t.push(e)}),t}function Wu(s){return s instanceof gi&&(s.color.equals(xS)&&!s.name&&s.color.set(12896462),s.shininess=18,s.specular.set(2236962)),s}var om=new Set(["revolute","continuous","prismatic"]),pc=class{constructor(t,e,i,n,r){this.name=t;this.root=e;this.urdf=i;this.ends=n;this.info=r;let o=r?.joints??Object.values(e.joints).map(AS);this.links=r?.links??Object.keys(e.links),this.joints=o.filter(l=>om.has(l.type)&&!l.mimic).map(MS);let a=new Map(o.map(l=>[l.name,l]));this.#t=o.filter(l=>om.has(l.type)).map(l=>TS(e,l,a));for(let{joint:l,leader:c}of this.#t)this.#e.set(l.name,c)}name;root;urdf;ends;info;joints;links;meshes={wanted:0,shown:0,failed:[]};#t;#e=new Map;get title(){return this.name??"Unsaved table"}place(t){for(let{joint:e,leader:i,multiplier:n,offset:r}of this.#t)is.prototype.setJointValue.call(e,n*(t[i]??0)+r);this.root.updateMatrixWorld(!0)}link(t){let e=this.root.links[t];if(!e)throw new Error(`the description has no link ${t}`);return e}has(t){return t!==null&&t in this.root.links}pose(t,e){return this.link(t).matrixWorld.clone().invert().multiply(this.link(e).matrixWorld)}moving(t){let e=new Set(t.map(n=>n.name)),i=new Set;for(let{joint:n,leader:r}of this.#t)e.has(r)&&n.traverse(o=>o instanceof st&&i.add(o));return[...i]}chain(t,e){let i=this.#n(t),n=this.#n(e);for(;i.length&&n.length&&i.at(-1)===n.at(-1);)i.pop(),n.pop();let r=[...i,...n.reverse()].map(a=>this.#e.get(a.name));return[...new Set(r)].flatMap(a=>this.joints.find(l=>l.name===a)??[])}home(t,e){let i=new Set(this.chain(t,e).map(n=>n.name));return this.#i(n=>n.lower===null||n.upper===null?0:i.has(n.name)?(n.lower+n.upper)/2:wS(0,n))}zero(){return this.#i(()=>0)}random(t,e,i){let n=this.chain(t,e).map(r=>{let{lower:o,upper:a}=Xu(r);return[r.name,o+Math.random()*(a-o)]});return{...i,...Object.fromEntries(n)}}complete(t,e,i){let n=this.home(e,i);if(t&&!Array.isArray(t))return this.#i(o=>t[o.name]??n[o.name]);let r=t;return r?.length!==this.joints.length?n:Object.fromEntries(this.joints.map((o,a)=>[o.name,r[a]]))}#i(t){return Object.fromEntries(this.joints.map(e=>[e.name,t(e)]))}#n(t){let e=[];for(let i=this.link(t);i;i=i.parent)i instanceof is&&e.push(i);return e}};function Xu(s){let t=s.type==="prismatic"?1:Math.PI;return{lower:s.lower??-t,upper:s.upper??t}}function am(s,t){return s.lower!==null&&t<s.lower||s.upper!==null&&t>s.upper}function wS(s,t){return Math.max(t.lower??-1/0,Math.min(t.upper??1/0,s))}function MS(s){let t=s.type!=="continuous";return{name:s.name,type:s.type,lower:t?s.limits.lower:null,upper:t?s.limits.upper:null}}function TS(s,t,e){let i=s.joints[t.name];i.ignoreLimits=!0,i.mimicJoints=[];let[n,r,o]=[t,1,0];for(let a=0;n.mimic&&a<e.size;a+=1)o+=r*n.mimic.offset,r*=n.mimic.multiplier,n=e.get(n.mimic.joint);return{joint:i,leader:n.name,multiplier:r,offset:o}}function AS(s){let{lower:t,upper:e,velocity:i,effort:n}=s.limit,r="mimicJoint"in s?s:null;return{name:s.name,type:s.jointType,parent:"",child:"",limits:{lower:t,upper:e,velocity:i,effort:n},mimic:r&&{joint:r.mimicJoint,multiplier:r.multiplier,offset:r.offset}}}var Ho={base_frame:"base",tip_frame:"tool"};function mc(s){return{dh:s,base:Ho.base_frame}}async function gc(s,t,e){let{draft:i,model:n,base:r,tip:o}=t;if(i)return mc(i);if(n?.name==null)return null;if(n.info?.dh&&ES(t))return mc(n.info.dh);let a=await s.get(qu(n.name,"standard",r,o),e);return{dh:a.dh,base:a.base_frame}}function ES({model:s,base:t,tip:e}){let i=[t??s?.ends.base_frame,e??s?.ends.tip_frame];return i[0]===Ho.base_frame&&i[1]===Ho.tip_frame}function qu(s,t,e,i){let n=new URLSearchParams({convention:t});return e&&n.set("base_frame",e),i&&n.set("tip_frame",i),`v1/robots/${encodeURIComponent(s)}/dh?${n}`}var RS="draft",xc=class{constructor(t,e,i){this.api=t;this.store=e;this.shown=i}api;store;shown;#t=new Ye;#e=new Ye;#i=null;follow(t){this.#i=t,this.store.watch(["robot","draft"],()=>{this.#n()}),this.store.watch(["dh","model","base","tip"],()=>{this.#c()})}startAt(t){this.#i=t}async#n(){let{robot:t,draft:e}=this.store.value;if(!(!t&&!e)){this.store.set({loading:!0,failure:null});try{let i=await this.#t.run(n=>e?this.#r(e,n):this.#s(t,n));i&&this.#l(i)}catch(i){this.store.set({loading:!1,failure:ze(i)})}}}async#s(t,e){let i=`v1/robots/${encodeURIComponent(t)}`,[n,r]=await Promise.all([this.api.get(i,e),this.api.text(`${i}/urdf`,e)]),o=rm(l=>this.api.url(`${i}/meshes/${l.split("/").map(encodeURIComponent).join("/")}`)),a=new Map(n.meshes.map(({reference:l,path:c})=>[l,c]));return this.#o(t,r,n.default_chain,n,l=>a.get(l)??null,o)}async#r(t,e){let i=await this.api.post("v1/dh/to-urdf",{name:RS,dh:t},e);return this.#o(null,i.urdf,Ho,null,()=>null,async()=>new st)}#o(t,e,i,n,r,o){let a=[],l=new em(new jn);l.packages=u=>`package://${u}`,l.loadMeshCb=(u,d,f,m)=>{let x=r(u);a.push(p=>this.#a(p,u,x,()=>o(x,Wu(f)),m))};let c=l.parse(e);c.traverse(u=>{u instanceof st&&Wu(u.material)});let h=new pc(t,c,e,i,n);h.meshes.wanted=a.length;for(let u of a)u(h);return h}async#a(t,e,i,n,r){if(i===null){t.meshes.failed.push(e);return}try{r(await n()),t.meshes.shown+=1}catch{t.meshes.failed.push(e)}this.shown(t)}#l(t){let e=this.store.value,i=e.model,n=t.has(e.base)?e.base:null,r=t.has(e.tip)?e.tip:null,[o,a]=[n??t.ends.base_frame,r??t.ends.tip_frame],l=t.complete(this.#i??CS(i,t,e.positions),o,a);this.#i=null,t.place(l);let c=e.draft&&mc(e.draft);this.store.set({model:t,positions:l,base:n,tip:r,table:c,loading:!1,failure:null})}async#c(){let{dh:t,draft:e,model:i}=this.store.value;if(!(e||!i||i.name===null)){if(!t){this.#e.cancel(),this.store.set({table:null});return}try{let n=await this.#e.run(r=>gc(this.api,this.store.value,r));n&&this.store.set({table:n})}catch{this.store.set({table:null})}}}};function CS(s,t,e){return s?lm(s)===lm(t)?e:s.name===null&&t.name===null&&s.joints.length===t.joints.length?s.joints.map(({name:n})=>e[n]):null:null}function lm(s){return s.joints.map(({name:t})=>t).join()}function ze(s){return s instanceof We?s:new We(Jp,"This robot cannot be shown",String(s))}var PS=/^[A-Za-z0-9][A-Za-z0-9_.-]{0,63}$/;function Fs(s){return PS.test(s)}async function cm(s){let i=((hm(s)?null:/<robot\b[^>]*\bname\s*=\s*["']([^"']+)["']/.exec(await s.text())?.[1])??s.name.replace(/(\.urdf|\.xml|\.zip)+$/i,"")).replace(/[^A-Za-z0-9_.-]+/g,"_").replace(/^[^A-Za-z0-9]+/,"").slice(0,64);return Fs(i)?i:"my_robot"}function hm(s){return/\.zip$/i.test(s.name)||s.type==="application/zip"}async function um(s,t,e,i){let n=i?{method:"PUT",path:`v1/robots/${encodeURIComponent(e)}`}:{method:"POST",path:"v1/robots"},r=i?{}:{name:e};return hm(t)?s.call({...n,form:{fields:r,archive:t}}):s.call({...n,body:{...r,urdf:await t.text()}})}function P(s,t={},...e){let i=document.createElement(s);for(let[n,r]of Object.entries(t))typeof r=="function"?i.addEventListener(n.slice(2),r):r===!0?i.setAttribute(n,""):r!==!1&&r!==null&&r!==void 0&&i.setAttribute(n,String(r));return i.append(...e.filter(n=>n!=null&&n!==!1)),i}function ai(s,...t){return P("section",{class:"section"},P("h2",{},s),...t)}function Vt(s,t,e={}){return P("button",{type:"button",class:"button",onclick:t,...e},s)}var _e=class{host;#t;constructor(t,e,i){this.#t=new Map(e.map(({value:n,text:r})=>[n,Vt(r,()=>i(n),{class:"choice-option"})])),this.host=P("div",{class:"choice",role:"group","aria-label":t},...this.#t.values())}allow(t,e){let i=this.#t.get(t);i.disabled=e!==null,i.title=e??""}show(t){for(let[e,i]of this.#t)i.setAttribute("aria-pressed",String(e===t))}};function Ki(s,t,e){return Vt(s,e,{class:"toggle",title:t,"aria-pressed":"false"})}var Ae=class{host=P("div",{class:"problem",role:"alert",hidden:!0});show(t){if(this.host.hidden=t===null,!t){this.host.replaceChildren();return}let e=IS(t);this.host.replaceChildren(P("strong",{},t.title),P("p",{},t.detail),...e?[P("p",{class:"muted"},e)]:[])}};function IS(s){if(s.status===Bu)return"Start it again with ./dev serve, then reload this page.";let t=s.facts.similar;return Array.isArray(t)&&t.length?`Similar names: ${t.join(", ")}.`:s.status===404?"It may have been removed. The Robot panel lists what there is.":s.status===409?"Choose another name.":s.status===413?"Leave out what is not needed, such as collision meshes.":s.status===429||s.status===503?"Wait a moment, then try again.":s.status>=500?"The service's log tells more.":null}var Dn=null;function dm(s){Dn=s}function fm(){return Dn!==null}function pm(s,{api:t,store:e}){let i=new Ae,n=P("input",{type:"file",accept:".urdf,.xml,.zip",class:"file",id:"robot-file"}),r=P("input",{type:"text",class:"text",id:"robot-name",autocomplete:"off",spellcheck:"false"}),o=P("p",{class:"muted"},"A URDF with its xacro expanded, or a zip of one URDF and its meshes. It may be dropped anywhere on the page."),a=d=>async()=>{if(!Dn)return;let f=r.value.trim();if(i.show(Fs(f)?null:new We(422,"This is no name","1 to 64 letters, digits, _, . or -, the first one a letter or digit.")),!!Fs(f)){h(!0);try{await um(t,Dn,f,d),Dn=null,c.hidden=!0,o.textContent=`${f} is on the screen.`,e.set({robot:"",draft:null}),e.set({robot:f,base:null,tip:null,target:null})}catch(m){let x=ze(m);i.show(x),c.hidden=x.status!==409}finally{h(!1)}}},l=Vt("Add",()=>{a(!1)()},{class:"button primary"}),c=Vt("Replace the one of this name",()=>{a(!0)()},{hidden:!0}),h=d=>{for(let f of[l,c])f.disabled=d||!Dn},u=async d=>{Dn=d,i.show(null),c.hidden=!0,o.textContent=`${d.name}, ${Math.ceil(d.size/1024)} kB`,r.value=await cm(d),await a(!1)()};return n.addEventListener("change",()=>{let d=n.files?.[0];d&&u(d)}),s.append(o,P("label",{class:"field",for:"robot-file"},"File"),n,P("label",{class:"field",for:"robot-name"},"Name"),P("div",{class:"bar"},r,l,c),i.host),h(!1),Dn&&u(Dn),()=>{}}function mm(s,t){let e=i=>i.dataTransfer?.types.includes("Files")??!1;window.addEventListener("dragover",i=>{e(i)&&(i.preventDefault(),s.hidden=!1)}),window.addEventListener("dragleave",i=>{i.relatedTarget===null&&(s.hidden=!0)}),window.addEventListener("drop",i=>{if(!e(i))return;i.preventDefault(),s.hidden=!0;let n=i.dataTransfer?.files[0];n&&(dm(n),t())})}function ee(s){let{model:t,positions:e}=s;if(!t)return null;let i=s.base??t.ends.base_frame,n=s.tip??t.ends.tip_frame,r=t.chain(i,n);return{model:t,base:i,tip:n,joints:r,configuration:r.map(o=>e[o.name]??0),ends:{base_frame:i,tip_frame:n},path:t.name===null?null:`v1/robots/${encodeURIComponent(t.name)}`}}function Dr(s,t){let e=Vt("Copy",()=>{i()},{class:"button small",title:`Copy ${t}`,"aria-label":`Copy ${t}`}),i=async()=>{try{await navigator.clipboard.writeText(s()),e.textContent="Copied"}catch{e.textContent="Not allowed"}setTimeout(()=>e.textContent="Copy",1500)};return e}var LS=[{value:"curl",text:"curl"},{value:"python",text:"Python"},{value:"json",text:"JSON"}],bi=class{constructor(t,e=""){this.service=t;this.api=t.recorded(r=>this.show(r)),this.#n=new _e("Language",LS,r=>{this.#e=r,this.#s()});let i=P("div",{class:"bar"},this.#n.host,Dr(()=>this.#i.textContent??"","the request")),n=P("pre",{tabindex:"0",role:"region","aria-label":e?`The request: ${e}`:"The request"},this.#i);this.host=P("details",{class:"request",hidden:!0},P("summary",{},e?`As request: ${e}`:"As request"),P("div",{class:"request-body"},i,n))}service;host;api;#t=null;#e="curl";#i=P("code");#n;show(t){this.#t=t,this.#s()}#s(){this.host.hidden=this.#t===null,this.#n.show(this.#e),this.#t&&(this.#i.textContent=NS[this.#e](this.service.url(this.#t.path),this.#t))}},NS={curl:DS,python:zS,json:kS};function DS(s,t){let i=[`curl -s${t.method==="GET"||t.method==="POST"&&(t.body||t.form)?"":` -X ${t.method}`} ${yc(s)}`];if(t.form){for(let[n,r]of Object.entries(t.form.fields))i.push(`-F ${yc(`${n}=${r}`)}`);i.push(`-F ${yc(`archive=@${t.form.archive.name}`)}`)}else t.body!==void 0&&i.push("-H 'Content-Type: application/json'",`-d ${yc(Go(t.body,JSON.stringify))}`);return i.join(` \\
  `)}function zS(s,t){if(t.form)return["import requests","",`with open(${Os(t.form.archive.name)}, "rb") as archive:`,`    answer = requests.${t.method.toLowerCase()}(`,`        ${Os(s)},`,`        data=${Os(t.form.fields)},`,'        files={"archive": archive},',"    )","print(answer.json())"].join(`
`);let e=t.body===void 0&&t.method==="GET"?`urlopen(${Os(s)})`:"urlopen(request)",i=["import json",`from urllib.request import ${e.includes("request)")?"Request, ":""}urlopen`,""];t.body!==void 0&&i.push(`call = ${Os(t.body,0)}`),e.includes("request)")&&(i.push("request = Request(",`    ${Os(s)},`),t.body!==void 0&&i.push("    data=json.dumps(call).encode(),",'    headers={"Content-Type": "application/json"},'),(t.method!=="POST"||t.body===void 0)&&i.push(`    method=${Os(t.method)},`),i.push(")"));let n=t.path.endsWith("/urdf")?"answer.read().decode()":"json.dumps(json.load(answer), indent=2)";return[...i,`with ${e} as answer:`,`    print(${n})`].join(`
`)}function kS(s,t){let e=`${t.method} /${t.path}`;return t.form?`${e}

${gm(t.form.fields)}
+ archive: ${t.form.archive.name}`:t.body===void 0?e:gm(t.body)}function yc(s){return`'${s.replaceAll("'","'\\''")}'`}function gm(s){return _c(s,0,t=>JSON.stringify(t))}function Os(s,t){let e=i=>i===null?"None":i===!0?"True":i===!1?"False":JSON.stringify(i);return t===void 0?Go(s,e):_c(s,t,e)}function _c(s,t,e){let i=Go(s,e);if(i.length+4*t<72||s===null||typeof s!="object")return i;let n="    ".repeat(t+1),r="    ".repeat(t),o=Array.isArray(s),a=o?s.map(l=>_c(l,t+1,e)):Object.entries(s).map(([l,c])=>`${JSON.stringify(l)}: ${_c(c,t+1,e)}`);return`${o?"[":"{"}
${a.map(l=>n+l).join(`,
`)}
${r}${o?"]":"}"}`}function Go(s,t){return Array.isArray(s)?`[${s.map(e=>Go(e,t)).join(", ")}]`:s===null||typeof s!="object"?t(s):`{${Object.entries(s).map(([e,i])=>`${JSON.stringify(e)}: ${Go(i,t)}`).join(", ")}}`}function vc({api:s,store:t},e){let i=new Ae,n=P("input",{type:"text",class:"text",id:"table-name",value:"my_arm",autocomplete:"off",spellcheck:"false"}),r=a=>async()=>{let l=e(),c=n.value.trim();if(i.show(Fs(c)?null:new We(422,"This is no name","1 to 64 letters, digits, _, . or -, the first one a letter or digit.")),!(!l||!Fs(c)))try{let h=`v1/robots/${encodeURIComponent(c)}`;a?await s.call({method:"PUT",path:h,body:{dh:l}}):await s.call({method:"POST",path:"v1/robots",body:{name:c,dh:l}}),o.hidden=!0,t.set({robot:c,draft:null,base:null,tip:null})}catch(h){let u=ze(h);i.show(u),o.hidden=u.status!==409}},o=Vt("Replace the one of this name",()=>{r(!0)()},{hidden:!0});return P("div",{class:"keep"},P("label",{class:"field",for:"table-name"},"Name at the service"),P("div",{class:"bar"},n,Vt("Add to the robots",()=>{r(!1)()},{class:"button primary"}),o),i.host)}function bc(s,t,e){let{store:i}=t,n=ai("Add the table to the robots",P("p",{class:"muted small"},"This panel asks the service about the robot, which does not keep it yet."),vc(t,()=>i.value.draft)),r=null,o=()=>{},a=i.watch(["model","draft"],l=>{let c=l.draft===null&&ee(l)?.path!=null;c===r||!c&&l.draft===null||(o(),r=c,s.replaceChildren(),o=c?e():()=>{},c||s.append(n))});return()=>{a(),o()}}function ym(s,t,e){let i=s.trim().toLowerCase().replaceAll("−","-").replaceAll(",",".");if(t==="length")return xm(i.replace(/\s*m$/,""))?.value??null;let n=null;/(°|deg)$/.test(i)?n="deg":/rad$/.test(i)&&(n="rad"),i=i.replace(/\s*(°|deg|rad)$/,"");let r=xm(i);return r?n==="deg"||n===null&&e&&!r.hasPi?r.value*Math.PI/180:r.value:null}function xm(s){let t=s.startsWith("-")?-1:1,e=s.replace(/^[+-]/,"").match(/(\d+\.?\d*|\.\d+)(e[+-]?\d+)?|pi|π|[*/·]|\s+|./g),i=t,n="*",r=!1,o=!0;for(let a of e??[]){if(/^\s+$/.test(a))continue;if(/^[*/·]$/.test(a)){if(o)return null;n=a,o=!0;continue}let l=a==="pi"||a==="π";if(!o&&!l)return null;let c=l?Math.PI:Number(a);if(!Number.isFinite(c))return null;i=n==="/"?i/c:i*c,r||=l,n="*",o=!1}return o||!Number.isFinite(i)?null:{value:i,hasPi:r}}function Wo(s,t,e,i=4){return t==="length"?ju(s,i):e?ju(s*180/Math.PI,Math.max(i-2,1)):_m(s)??ju(s,i)}function zr(s,t,e){return t==="length"?String(s):_m(s)??String(e?s*180/Math.PI:s)}function Bi(s,t){return s==="length"?"m":t?"°":"rad"}function ju(s,t){let e=s.toFixed(t).replace(/\.?0+$/,"");return(e==="-0"?"0":e).replace("-","−")}function _m(s){for(let t of[1,2,3,4,6]){let e=Math.round(s*t/Math.PI);if(e===0||Math.abs(e)>24||e*Math.PI/t!==s)continue;let i=Math.abs(e)===1?"π":`${Math.abs(e)}π`;return`${e<0?"−":""}${i}${t===1?"":`/${t}`}`}return null}function Qi(s){if(s===0)return"0";let[t,e]=s.toExponential(1).split("e"),i=[...e.replace("+","")].map(n=>n==="-"?"⁻":"⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(n)]).join("");return`${t}·10${i}`}function Si(s,t){let e=s.toFixed(t);return(Number(e)===0?e.replace("-",""):e).replace("-","−")}function wi(s){if(s===0)return"0";let t=Math.abs(s),e=s<0?"−":"";return t<.001||t>=1e5?e+Qi(t):e+(t>=100?t.toFixed(0):t.toPrecision(3))}function fn(s){return[...String(s)].map(t=>"₀₁₂₃₄₅₆₇₈₉"[Number(t)]).join("")}var vm=1e-9,Sc=class{constructor(t,e){this.api=t;this.problem=e}api;problem;host=P("p",{class:"agreement",role:"status"});#t=new Ye;stop(){this.#t.cancel()}async check(t,e){if(t.path===null){this.#t.cancel(),this.#i("idle","Add the table to the robots (Robot, DH table) to compare this with the service.");return}let i={joint_positions:[t.configuration],...t.ends,pose_format:"matrix"};try{let n=`${t.path}/fk`,r=await this.#t.run(o=>this.api.post(n,i,o));if(!r)return;this.problem.show(null),this.#e(e,r,t.joints.map(o=>o.name))}catch(n){this.#i("idle",""),this.problem.show(ze(n))}}#e(t,e,i){let n=qp(t,Pe(e.poses[0])),o=i.join()===e.joint_names.join()&&n.position<vm&&n.angle<vm,a=`${Qi(e.certificate.max_position_error)} m`;this.host.dataset.position=String(n.position),this.host.dataset.angle=String(n.angle),this.#i(o?"good":"bad",`Browser and service ${o?"agree":"differ"}: ${Qi(n.position)} m, ${Qi(n.angle)} rad apart. Service and Pinocchio: ${a}.`)}#i(t,e){this.host.dataset.tone=t,this.host.textContent=e}};var FS={length:"Write a number such as 0.35",angle:"Write a number such as 0.35, pi/2 or 90°"},Vi=class{constructor(t){this.options=t;this.input=P("input",{class:"number",type:"text",inputmode:"decimal",autocomplete:"off",spellcheck:"false","aria-label":t.label,onfocus:()=>this.#n(),onblur:()=>this.#s(),oninput:()=>this.#r(),onkeydown:e=>{e.key==="Enter"&&this.#o(),e.key==="Escape"&&this.#l(),(e.key==="ArrowUp"||e.key==="ArrowDown")&&this.#a(e)}})}options;input;#t=null;#e=!1;get value(){return this.#t}set(t){this.#t=t,!this.#e&&this.#i(document.activeElement===this.input?zr:Wo)}fail(t){this.input.setAttribute("aria-invalid",String(t!==null)),this.input.title=t??""}#i(t){let{kind:e,degrees:i,decimals:n}=this.options;this.input.value=this.#t===null?"":t(this.#t,e,i(),n)}#n(){this.#i(zr),this.input.select()}#s(){this.#o(),this.#e||this.#i(Wo)}#r(){this.#e=!0;let t=this.#h();this.options.live&&t!==void 0&&this.#c(t)}#o(){if(!this.#e)return;let t=this.#h();t!==void 0&&(this.#e=!1,this.#c(t),document.activeElement===this.input&&this.#i(zr))}#a(t){let{step:e}=this.options,i=this.#e?this.#h():this.#t;if(!e||i===null||i===void 0)return;t.preventDefault(),this.#e=!1;let n=(t.key==="ArrowUp"?1:-1)*(t.shiftKey?10:1),r=this.options.kind==="angle"&&this.options.degrees()?180/Math.PI:1;this.#t=Number(((i+n*e.by)*r).toPrecision(15))/r,this.#i(zr),e.take(this.#t)}#l(){this.#e=!1,this.fail(null),this.options.invalid?.(null),this.#i(zr),this.input.select()}#c(t){this.#t=t,this.options.change(t)}#h(){let{kind:t,degrees:e,optional:i,invalid:n}=this.options,r=this.input.value,o=i&&r.trim()===""?null:ym(r,t,e()),a=o===null&&!(i&&r.trim()==="")?FS[t]:null;return this.fail(a),n?.(a),a===null?o:void 0}};var ss=class{constructor(t){this.store=t}store;host=P("div",{class:"joints"});#t=[];build(){let t=ee(this.store.value);if(this.#t=[],this.host.replaceChildren(),!t)return;let e=t.model.joints.filter(i=>!t.joints.includes(i));if(this.host.append(...t.joints.map(i=>this.#e(i))),t.joints.length===0&&this.host.append(P("p",{class:"muted"},"No joint moves between these two frames.")),e.length){let i=`Other joints (${e.length})`;this.host.append(P("details",{class:"others"},P("summary",{},i),...e.map(n=>this.#e(n))))}this.update()}update(){let{positions:t}=this.store.value;for(let{joint:e,slider:i,field:n,host:r}of this.#t){let o=t[e.name]??0;Number(i.value)!==o&&(i.value=String(o)),n.set(o),r.classList.toggle("beyond",am(e,o))}}#e(t){let{lower:e,upper:i}=Xu(t),n=t.type==="prismatic"?"length":"angle",r=()=>this.store.value.degrees,o=d=>{d!==null&&this.store.set({positions:{...this.store.value.positions,[t.name]:d}})},a=P("input",{type:"range",min:e,max:i,step:"any","aria-label":t.name,oninput:()=>o(Number(a.value)),onkeydown:d=>OS(d,a,o)}),l=new Vi({label:`${t.name}, number`,kind:n,degrees:r,change:o}),c=d=>()=>this.store.set({joint:d}),h=d=>Wo(d,n,r(),3),u=P("div",{class:"joint",onpointerenter:c(t.name),onpointerleave:c(null),onfocusin:c(t.name),onfocusout:c(null)},P("span",{class:"joint-name",title:t.name},t.name),P("span",{class:"entry"},l.input,P("span",{class:"unit"},Bi(n,r()))),P("span",{class:"slide"},P("span",{class:"limit"},t.lower===null?"":h(e)),a,P("span",{class:"limit"},t.upper===null?"":h(i))));return this.#t.push({joint:t,slider:a,field:l,host:u}),u}};function OS(s,t,e){let i={ArrowLeft:-1,ArrowDown:-1,ArrowRight:1,ArrowUp:1,PageDown:-10,PageUp:10}[s.key];if(i===void 0)return;s.preventDefault();let[n,r]=[Number(t.min),Number(t.max)],o=Number(t.value)+i*(r-n)/100;e(Math.max(n,Math.min(r,o)))}var bm=5,wc=class{host;#t=P("p",{class:"muted"});#e=new Map;#i=null;constructor(){let t=(n,r)=>{let o=P("output",{class:"numbers","data-format":n,"aria-label":r});this.#e.set(n,o);let l=Dr(()=>JSON.stringify(this.#i&&(n==="position"?ks(this.#i):di(this.#i,n))),r);return[P("dt",{},r),P("dd",{},o),P("dd",{class:"copy"},l)]},e=Pr.filter(({format:n})=>n!=="rotation"&&n!=="matrix"),i=Pr.filter(({format:n})=>n==="rotation"||n==="matrix");this.host=P("div",{},this.#t,P("dl",{class:"pose"},...t("position","Position"),...e.flatMap(({format:n,title:r})=>t(n,r))),P("details",{},P("summary",{},"As matrices"),P("dl",{class:"pose"},...i.flatMap(({format:n,title:r})=>t(n,r)))))}show(t,e,i,n){this.#i=t,this.#t.textContent=`of ${i} in ${e}`,this.host.dataset.matrix=JSON.stringify(di(t,"matrix").matrix);for(let[r,o]of this.#e)o.replaceChildren(...US(t,r,n))}};function US(s,t,e){if(t==="position")return[Yu(ks(s),"m")];let i=di(s,t)[t];if(Array.isArray(i[0]))return i.map(o=>Yu(o,""));let n=Kl.has(t),r=i.map(o=>n&&e?o*180/Math.PI:o);return[Yu(r,n?e?"°":"rad":"",n&&e?3:bm)]}function Yu(s,t,e=bm){let i=s.map(n=>P("span",{},Si(n,e)));return P("span",{class:"row"},...i,t&&P("span",{class:"unit"},t))}var Sm={id:"pose",title:"Pose",open:BS};function BS(s,t){let{store:e,api:i}=t,n=new bi(i),r=new Ae,o=new ss(e),a=new wc,l=new Sc(n.api,r),c=new _e("Unit of angles",[{value:"rad",text:"rad"},{value:"deg",text:"deg"}],u=>e.set({degrees:u==="deg"}));s.append(ai("Joints",P("div",{class:"bar"},...$u(t),P("span",{class:"spring"}),c.host),o.host),ai("Tip",a.host,l.host,r.host),n.host);let h=[e.watch(["model","base","tip","degrees"],({degrees:u})=>{c.show(u?"deg":"rad"),o.build()}),e.watch(["model","base","tip","degrees","positions"],u=>{o.update();let d=ee(u);if(!d)return;let f=d.model.pose(d.base,d.tip);a.show(f,d.base,d.tip,u.degrees),l.check(d,f)}),()=>l.stop(),()=>e.set({joint:null})];return()=>{for(let u of h)u()}}function $u({store:s}){let t=r=>()=>{let o=ee(s.value);o&&s.set({positions:r(o)})},e=t(({model:r,base:o,tip:a})=>r.home(o,a)),i=t(({model:r})=>r.zero()),n=t(({model:r,base:o,tip:a})=>r.random(o,a,s.value.positions));return[Vt("Home",e,{title:"Each joint of the chain in the middle of its range"}),Vt("Zero",i,{title:"Every joint at zero"}),Vt("Random",n,{title:"Each joint of the chain somewhere within its limits"})]}var wm=[{key:"measure",title:"Yoshikawa w",hint:"Manipulability, the product of the σ: √det(JJᵀ)"},{key:"condition_number",title:"Condition κ",hint:"The longest σ over the shortest"},{key:"rank",title:"Rank",hint:"Directions that the tip has here, of those that it has at all"},{key:"isotropy",title:"Isotropy 1/κ",hint:"The shortest σ over the longest: 1 is a sphere, 0 is singular"}],Mc=class{host;#t=P("tbody");#e=P("span",{class:"unit"});#i=P("span",{class:"unit"});#n=new Map;#s=P("p",{class:"muted small",hidden:!0},"The tip never moves in this way.");#r;constructor(){this.#r=P("table",{class:"axes"},P("thead",{},P("tr",{},P("th",{scope:"col",colspan:2},"Axis"),P("th",{scope:"col",colspan:2,class:"velocity"},"Velocity ",this.#e),P("th",{scope:"col",class:"force"},"Force ",this.#i))),this.#t);let t=wm.map(({key:e,title:i,hint:n})=>{let r=P("dd",{"data-measure":e});return this.#n.set(e,r),P("div",{title:n},P("dt",{},i),r)});this.host=P("div",{class:"part"},this.#s,this.#r,P("dl",{class:"measures"},...t))}show(t,e){let i=t.spaces.find(c=>c.part===e),n=t.results[0][e],r=n!==null&&i!==void 0&&i.dimension>0;if(this.#s.hidden=r,this.#r.hidden=!r,this.host.dataset.semiAxes=JSON.stringify(n?.velocity_ellipsoid.semi_axes??[]),!r){for(let c of this.#n.values())c.textContent="–";delete this.host.dataset.measures;return}this.#e.textContent=i.velocity_unit,this.#i.textContent=i.force_unit,this.#t.replaceChildren(...n.velocity_ellipsoid.axes.map((c,h)=>VS(n,c,h)));let o=i.measure_unit.replace(/\^(\d)/,(c,h)=>"⁰¹²³⁴⁵⁶"[Number(h)]),a=c=>c===null?"unbounded":wi(c),l={measure:`${a(n.measure)} ${o}`,condition_number:a(n.condition_number),isotropy:a(n.isotropy),rank:`${n.rank} of ${i.dimension}`};for(let{key:c}of wm)this.#n.get(c).textContent=l[c];this.host.dataset.measures=JSON.stringify(n,["measure","condition_number","isotropy","rank"])}};function VS(s,t,e){let i=s.velocity_ellipsoid.semi_axes[e],n=s.force_ellipsoid.semi_axes[e],r=s.velocity_ellipsoid.semi_axes[0],o=P("span",{class:"bar-fill"});return o.style.width=`${r>0?100*i/r:0}%`,P("tr",{class:i===0?"lost":""},P("th",{scope:"row"},`σ${fn(e+1)}`),P("td",{class:"direction"},...pn(t)),P("td",{class:"bar-cell"},P("span",{class:"bar-track"},o)),P("td",{title:String(i)},wi(i)),P("td",{title:String(n)},n===null?"∞":wi(n)))}function pn(s){return(s.length===6?[s.slice(0,3),s.slice(3)]:[s]).map((e,i)=>P("span",{},s.length===6?`${"vω"[i]} `:"",`(${e.map(n=>Si(n,2)).join(", ")})`))}var Us=[{value:"base",text:"Base axes",reference:"local_world_aligned",representation:"geometric",hint:"Geometric, of the tip, along the base's axes."},{value:"tip",text:"Tip axes",reference:"local",representation:"geometric",hint:"Geometric, of the tip, along the tip's own axes."},{value:"spatial",text:"Spatial",reference:"world",representation:"geometric",hint:"Geometric, along the base's axes, of the point of the tip's body that passes the base's origin."},{value:"zyz",text:"ZYZ",reference:"local_world_aligned",representation:"zyz",hint:"Analytic: the angular rows are the rates of the Euler angles ZYZ."},{value:"rpy",text:"RPY",reference:"local_world_aligned",representation:"rpy",hint:"Analytic: the angular rows are the rates of roll, pitch and yaw."}],Tc=[{value:"translation",text:"Translation",task:["x","y","z"]},{value:"rotation",text:"Rotation",task:["rx","ry","rz"]},{value:"combined",text:"Both",task:["x","y","z","rx","ry","rz"]}];function Mm(s){return Am(s,"jacobian.form",Us)}function Tm(s){return Am(s,"jacobian.part",Tc)}function Am(s,t,e){let i=e.map(({value:n})=>n);return e[i.indexOf(sa(s,t,i))]}var Em=1;async function Rm(s,t,e,i,n){let r={joint_positions:[t.configuration],...t.ends},o=(f,{reference:m,representation:x})=>f.post(`${t.path}/jacobian`,{...r,reference:m,representation:x},n),a=i.value==="combined"?{characteristic_length:Em}:{},[l,c,h,u]=await Promise.all([o(s.matrix,e).catch(HS),e===Us[0]?null:o(s.other,Us[0]),s.axes.post(`${t.path}/manipulability`,{...r,...a},n),s.other.post(`${t.path}/singularities`,{...r,task:i.task,...a},n)]),d=c??(l instanceof We?null:l);if(!d)throw l;return{chain:t,form:e,part:i,matrix:l,columns:GS(d),axes:h,report:u.singularities[0]}}async function Cm(s,t,e,i){let n={joint_positions:[t.configuration],...t.ends,task:e.task,...e.value==="combined"?{characteristic_length:Em}:{},nearest:!0};return(await s.post(`${t.path}/singularities`,n,i)).singularities[0]}function HS(s){if(s instanceof We)return s;throw s}function GS({jacobians:s,joint_names:t}){return t.map((e,i)=>s[0].map(n=>n[i]))}var WS=["vx","vy","vz"],XS={geometric:["ωx","ωy","ωz"],zyz:["φ̇","ϑ̇","ψ̇"],rpy:["roll","pitch","yaw"]},Ac=class{constructor(t,e){this.store=t;this.visit=e;this.host.append(this.#e,this.#t)}store;visit;host=P("div",{class:"jacobian"});#t=P("p",{class:"muted small"});#e=P("div",{class:"jacobian-scroll",tabindex:"0",role:"region","aria-label":"The Jacobian"});#i=[];#n=[];#s=[];show(t,{representation:e,hint:i}){let n=t.jacobians[0];(t.joint_names.join()!==this.#i.join()||!this.#n.length)&&this.#r(t.joint_names);for(let[a,l]of[...this.#e.querySelectorAll("tbody th")].entries())l.textContent=[...WS,...XS[e]][a];for(let[a,l]of this.#n.entries())for(let[c,h]of l.entries())h.textContent=Si(n[a][c],3);this.host.dataset.jacobian=JSON.stringify(n);let r=t.condition_numbers[0],o=Math.min(6,t.joint_names.length);this.#t.textContent=`${i} Rank ${t.ranks[0]} of ${o}; condition number ${r==null?"unbounded":wi(r)}, metres and radians mixed. Pinocchio differs by ${wi(t.certificate.max_error)} at most.`,this.mark()}clear(){for(let t of this.#n.flat())t.textContent="·";delete this.host.dataset.jacobian,this.#t.textContent=""}mark(){let{joint:t}=this.store.value;for(let[e,i]of this.#s.entries())for(let n of i)n.classList.toggle("marked",this.#i[e]===t)}#r(t){this.#i=t;let e=t.map((i,n)=>this.#o(i,n));this.#n=[0,1,2,3,4,5].map(()=>t.map(i=>P("td",this.#a(i)))),this.#s=e.map((i,n)=>[i,...this.#n.map(r=>r[n])]),this.#e.replaceChildren(P("table",{},P("thead",{},P("tr",{},P("td"),...e)),P("tbody",{},...this.#n.map((i,n)=>P("tr",{class:n===3?"angular":""},P("th",{scope:"row"}),...i)))))}#o(t,e){let i=this.#a(t),n=`q${fn(e+1)}`;return P("th",{scope:"col",...i},P("button",{type:"button",class:"column",title:`${t}: go to its slider`,"aria-label":`${n}, ${t}: go to its slider`,onfocus:i.onpointerenter,onblur:i.onpointerleave,onclick:()=>this.visit(t)},n))}#a(t){return{onpointerenter:()=>this.store.set({joint:t}),onpointerleave:()=>this.store.set({joint:null})}}};var Ec=document.createElement("span");Ec.hidden=!0;document.documentElement.append(Ec);function me(s){return Ec.style.color=`var(--${s})`,new It(getComputedStyle(Ec).color)}var Xo=class extends te{constructor(t=document.createElement("div")){super(),this.isCSS2DObject=!0,this.element=t,this.element.style.position="absolute",this.element.style.userSelect="none",this.element.setAttribute("draggable",!1),this.center=new Rt(.5,.5),this.rotation2D=0,this.addEventListener("removed",function(){this.traverse(function(e){e.element&&e.element instanceof e.element.ownerDocument.defaultView.Element&&e.element.parentNode!==null&&e.element.remove()})})}copy(t,e){return super.copy(t,e),this.element=t.element.cloneNode(!0),this.center=t.center,this.rotation2D=t.rotation2D,this}},kr=new C,Pm=new wt,Im=new wt,Lm=new C,Nm=new C,Rc=class{constructor(t={}){let e=this,i,n,r,o,a={objects:new WeakMap},l=t.element!==void 0?t.element:document.createElement("div");l.style.overflow="hidden",this.domElement=l,this.sortObjects=!0,this.getSize=function(){return{width:i,height:n}},this.render=function(m,x){m.matrixWorldAutoUpdate===!0&&m.updateMatrixWorld(),x.parent===null&&x.matrixWorldAutoUpdate===!0&&x.updateMatrixWorld(),Pm.copy(x.matrixWorldInverse),Im.multiplyMatrices(x.projectionMatrix,Pm),h(m,m,x),this.sortObjects&&f(m)},this.setSize=function(m,x){i=m,n=x,r=i/2,o=n/2,l.style.width=m+"px",l.style.height=x+"px"};function c(m){m.isCSS2DObject&&(m.element.style.display="none");for(let x=0,p=m.children.length;x<p;x++)c(m.children[x])}function h(m,x,p){if(m.visible===!1){c(m);return}if(m.isCSS2DObject){kr.setFromMatrixPosition(m.matrixWorld),kr.applyMatrix4(Im);let g=kr.z>=-1&&kr.z<=1&&m.layers.test(p.layers)===!0,_=m.element;if(_.style.display=g===!0?"":"none",g===!0){m.onBeforeRender(e,x,p);let y=100*m.center.x,M=100*m.center.y;_.style.transformOrigin=`${y}% ${M}%`;let S=-m.rotation2D,v=kr.x*r+r,w=-kr.y*o+o;_.style.transform=`translate(${-y}%, ${-M}%) translate(${v}px, ${w}px) rotate(${S}rad)`,_.parentNode!==l&&l.appendChild(_),m.onAfterRender(e,x,p)}let b={distanceToCameraSquared:u(p,m)};a.objects.set(m,b)}for(let g=0,_=m.children.length;g<_;g++)h(m.children[g],x,p)}function u(m,x){return Lm.setFromMatrixPosition(m.matrixWorld),Nm.setFromMatrixPosition(x.matrixWorld),Lm.distanceToSquared(Nm)}function d(m){let x=[];return m.traverseVisible(function(p){p.isCSS2DObject&&x.push(p)}),x}function f(m){let x=d(m).sort(function(g,_){if(g.renderOrder!==_.renderOrder)return _.renderOrder-g.renderOrder;let b=a.objects.get(g).distanceToCameraSquared,y=a.objects.get(_).distanceToCameraSquared;return b-y}),p=x.length;for(let g=0,_=x.length;g<_;g++)x[g].element.style.zIndex=p-g}}};var qS=new Me(1,1,1,12).translate(0,.5,0),jS=new uo(1,1,16).translate(0,.5,0),Dm=new C(0,1,0),YS={x:new C(1,0,0),y:new C(0,1,0),z:new C(0,0,1)};function zm(s,t=1){return new ti({color:s,depthTest:!1,transparent:!0,opacity:t})}function rs(s,t,e,i,n=1){let r=new st(qS,zm(i,n));return Zu(r,s,t,e),r.renderOrder=10,r}function Zu(s,t,e,i){let n=e.clone().sub(t),r=n.length();s.visible=r>1e-9,s.position.copy(t),s.visible&&s.quaternion.setFromUnitVectors(Dm,n.divideScalar(r)),s.scale.set(i,r,i)}function Fr(s,t,e,i){let n=new Kt,r=Math.min(t*.3,e*7),o=new st(jS,zm(i));return o.quaternion.setFromUnitVectors(Dm,s.clone().normalize()),o.position.copy(s).setLength(t-r),o.scale.set(e*2.6,r,e*2.6),o.renderOrder=11,n.add(rs(new C,s.clone().setLength(t-r),e,i),o),n}function qo(s,t=["x","y","z"]){let e=new Kt;for(let i of t)e.add(Fr(YS[i],s,s*.03,me(i)));return e}function Bs(s,t){return new Xo(P("span",{class:`label ${t}`},s))}function zn(s,t){t.decompose(s.position,s.quaternion,new C)}function os(s){s.traverse(t=>{t instanceof Xo&&t.element.remove(),t instanceof st&&t.material instanceof ti&&t.material.dispose(),t instanceof Ge&&t.material.dispose()}),s.clear()}var $S=new Cn(1,48,32),ZS=new ce().setFromPoints(Array.from({length:96},(s,t)=>new C(Math.cos(t*Math.PI/48),Math.sin(t*Math.PI/48),0))),JS=new $i(1,.06,8,48,5/3*Math.PI),KS=3,Ju=20;function Um(s,t){let e=KS*t,i=s?.velocity_ellipsoid.semi_axes[0]||1,n=s?Ku(s.force_ellipsoid):[];return{velocity:e/i,force:e/(Math.max(...n,0)||1)}}function Ku(s){let t=s.semi_axes.filter(i=>i!==null),e=Ju*(t.length?Math.min(...t):1);return s.semi_axes.map(i=>Math.min(i??1/0,e))}function Bm(s){return Ku(s).some((t,e)=>t!==s.semi_axes[e])}var Cc=class{constructor(t){this.view=t;this.#t.name="at the tip",t.scene.add(this.#t)}view;#t=new Kt;show(t,e,i){os(this.#t),this.#t.setRotationFromMatrix(new wt().extractRotation(t.model.link(t.base).matrixWorld)),this.#t.position.setFromMatrixPosition(t.model.link(t.tip).matrixWorld);let{part:n,scale:r}=e;n&&e.force&&this.#i(n,r.force,i),n&&e.velocity&&this.#e(n,r.velocity,i);for(let o of e.lost)this.#n(o,i);e.column&&this.#s(e.column,e.turns,r.velocity,i),this.view.draw()}close(){os(this.#t),this.view.scene.remove(this.#t),this.view.draw()}#e({velocity_ellipsoid:{axes:t,semi_axes:e}},i,n){let r=e.map(a=>a*i),o=km(t,r,me("accent"),n);o.name="velocity ellipsoid",this.#t.add(o);for(let[a,l]of t.entries()){if(r[a]<.1*n)continue;let c=Bs(`σ${fn(a+1)}`,"velocity");c.position.copy(jo(l)).multiplyScalar(r[a]+.2*n),this.#t.add(c)}}#i({force_ellipsoid:t},e,i){let n=Ku(t).map(o=>o*e),r=km(t.axes,n,me("dimension-a"),i);r.name="force ellipsoid",this.#t.add(r)}#n(t,e){let i=2.2*e,[n,r]=[jo(t),jo(t.slice(3))],o=new Kt;o.name="lost direction";for(let a of[1,-1]){let l=n.clone().multiplyScalar(a);n.length()>.05&&o.add(Fr(l,i*n.length(),.05*e,me("bad")))}r.length()>.05&&o.add(tw(r,.8*i*r.length(),e,me("bad"))),this.#t.add(o)}#s(t,e,i,n){let r=jo(e?t.slice(3):t);if(r.length()*i<.02*n)return;let o=Fr(r,r.length()*i,.05*n,me("axis"));o.name="column",this.#t.add(o)}};function km(s,t,e,i){let n=new Kt,[r,o,a]=QS(s),l=1e-4*i,[c,h,u]=[t[0]??0,t[1]??0,t[2]??0].map(m=>Math.max(m,l)),d=new wt().makeBasis(r.clone().setLength(c),o.clone().setLength(h),a.clone().setLength(u)),f=new st($S,new ti({color:e,transparent:!0,opacity:.16,depthTest:!1,depthWrite:!1,side:si}));f.renderOrder=8,n.add(Om(f,d));for(let m of[d,Fm(r,c,a,u,o),Fm(o,h,a,u,r)]){let x=new ao(ZS,new ei({color:e,depthTest:!1,transparent:!0}));x.renderOrder=9,n.add(Om(x,m))}for(let[m,x]of[[r,c],[o,h],[a,u]]){if(x<=l)continue;let p=m.clone().setLength(x);n.add(rs(p.clone().negate(),p,.018*i,e))}return n}function Fm(s,t,e,i,n){return new wt().makeBasis(s.clone().setLength(t),e.clone().setLength(i),n)}function Om(s,t){return s.matrixAutoUpdate=!1,s.matrix.copy(t),s}function QS(s){let t=s.slice(0,3).map(jo);for(let e of[new C(1,0,0),new C(0,1,0),new C(0,0,1)]){if(t.length===3)break;let i=e.clone();for(let n of t)i.addScaledVector(n,-n.dot(e));i.length()>.5&&t.push(i.normalize())}return t}function tw(s,t,e,i){let n=new Kt,r=new st(JS,new ti({color:i,depthTest:!1,transparent:!0}));r.renderOrder=10,r.scale.setScalar(t*.5);let o=s.clone().setLength(t);return n.add(r,rs(o.clone().negate(),o,.03*e,i)),r.quaternion.setFromUnitVectors(new C(0,0,1),s.clone().normalize()),n}function jo(s){return new C(s[0],s[1],s[2])}var ew=.1,iw={wrist:"wrist (two of its axes on one line)",elbow:"elbow (the arm stretched or folded)",shoulder:"shoulder (the wrist where the first joint does not move it)"},Pc=class{host;#t=P("p",{role:"status"});#e=P("ul",{class:"words"});#i=P("p");#n;#s=null;constructor(t){this.#n=Vt("Go there",()=>this.#s&&t(this.#s),{class:"button small",hidden:!0}),this.host=P("div",{class:"part singularity"},this.#t,this.#e,P("div",{class:"nearest"},this.#i,this.#n))}show(t,e){let i=!t.singular&&e!==null&&Qu(e);this.host.dataset.singular=String(t.singular),this.#t.dataset.tone=t.singular?"bad":i?"weak":"good",this.#t.textContent=t.singular?`Singular: rank ${t.rank} of ${t.structural_rank}.`:i?`Close to singular: the smallest σ is 1/${wi(1/e.isotropy)} of the largest.`:t.structural_rank===0?"The tip never moves in this way.":"Regular: the tip moves in every direction that it has at all.",this.#e.replaceChildren(...[...sw(t),...i?rw(e):[],...ow(t)].map(nw))}nearest(t,e=[]){let i=t?.nearest??null;if(this.#s=i?.joint_positions??null,this.#n.hidden=i===null||i.distance===0,this.host.dataset.distance=i?String(i.distance):"",t===null)this.#i.textContent="Nearest singularity: …";else if(!i)this.#i.textContent=uw(t.nearest_reason??"no singularity was found");else if(i.distance===0)this.#i.textContent="Nearest singularity: here.";else{let n=i.kinds.length?` (${i.kinds.join(", ")})`:"";this.#i.textContent=`Nearest singularity found${n}: ${wi(i.distance)} ${cw(e)} away, by ${i.joints.join(", ")}${i.within_limits?"":"; beyond the joint limits"}.`}}};function Qu({isotropy:s}){return s!==null&&s>0&&s<ew}function nw(s){return P("li",{},...s)}function sw({lost_directions:s,kinds:t}){let e=s.filter(({lost_here:i})=>i);return[...t.map(i=>[`Its name: ${iw[i]??i}.`]),...e.map(({twist:i})=>["The tip cannot ",...aw(i),": drawn in red."]),...e.map(({wrench:i})=>["No joint feels ",...lw(i)," at the tip."])]}function rw(s){let{axes:t,semi_axes:e}=s.velocity_ellipsoid,i=P("span",{},`σ = ${wi(e.at(-1))}`);return[["It is weakest along ",...as(pn(t.at(-1)))," with ",i,", drawn in red."]]}function ow({dependent_joints:s,internal_motions:t,exit:e,singular:i}){let n=t.filter(({only_here:r})=>!r).length;return[...s.length?[[`Joints that undo each other here: ${s.join(", ")}.`]]:[],...n?[[`The joints also have ${hw(n)} of which none of these directions notices anything.`]]:[],...e?[[`${i?"The way out":"Away from singularities"}: above all ${e.joint}.`]]:[]]}function aw(s){let[t,e]=[s.slice(0,3),s.slice(3)];return Or(e)<1e-6?["move along ",...as(pn(t))]:Or(t)<1e-6?["turn about ",...as(pn(e))]:["move as ",...as(pn(s))]}function lw(s){let[t,e]=[s.slice(0,3),s.slice(3)];return Or(e)<1e-6?["a force along ",...as(pn(t))]:Or(t)<1e-6?["a moment about ",...as(pn(e))]:["a force along ",...as(pn(t)),` with a moment (${wi(Or(e)/Or(t))} m) about `,...as(pn(e))]}function as(s){return s.flatMap((t,e)=>e?[" ",t]:[t])}function cw(s){let t=s.filter(({type:e})=>e==="prismatic").length;return t===0?"rad":t===s.length?"m":"(rad and m)"}function Or(s){return Math.hypot(...s)}function hw(s){return s===1?"one motion":`${s} independent motions`}function uw(s){return s.charAt(0).toUpperCase()+s.slice(1)+"."}var td=["both","velocity","force","none"];function Ic(s,t){return s==="both"||s===t}var Lc=class{constructor(t){this.studio=t;this.#t=t.view&&new Cc(t.view);let{store:e}=t,i=r=>()=>{let o={...this.#s,[r]:!this.#s[r]},a=td.find(l=>o.velocity===Ic(l,"velocity")&&o.force===Ic(l,"force"));e.set(ra(e.value,"jacobian.ellipsoids",a===td[0]?null:a))},n=()=>{this.#i=this.#i?null:this.#a(),this.draw()};this.#e={velocity:Ki("Velocity","Where joint rates of norm one take the tip",i("velocity")),force:Ki("Force","What joint torques of norm one bear at the tip",i("force")),hold:Ki("Hold scale","Keep the scale of the picture while the joints move",n)},this.#e.velocity.classList.add("velocity"),this.#e.force.classList.add("force"),this.host=P("span",{class:"toggles"},...Object.values(this.#e))}studio;host;words=P("p",{class:"muted small"});#t;#e;#i=null;#n=null;show(t){(t.part!==this.#n?.part||t.chain.model!==this.#n.chain.model)&&(this.#i=null),this.#n=t,this.draw()}draw(){let{velocity:t,force:e}=this.#s;this.#e.velocity.setAttribute("aria-pressed",String(t)),this.#e.force.setAttribute("aria-pressed",String(e)),this.#e.hold.setAttribute("aria-pressed",String(this.#i!==null)),this.words.textContent=this.#c();let i=this.#n;if(!i||!this.#t)return;let{joint:n,unit:r}=this.studio.store.value,{report:o,columns:a,chain:l}=i,c=o.lost_directions.filter(({lost_here:u})=>u).map(({twist:u})=>u),h={part:this.#o(),turns:i.part.value==="rotation",velocity:t,force:e,lost:c.length?c:this.#l(),column:a[l.joints.findIndex(({name:u})=>u===n)]??null,scale:this.#a()};this.#t.show(l,h,r)}close(){this.#t?.close()}get#s(){let t=sa(this.studio.store.value,"jacobian.ellipsoids",td);return{velocity:Ic(t,"velocity"),force:Ic(t,"force")}}get#r(){return this.#n?.axes.results[0][this.#n.part.value]??null}#o(){let t=this.#n?.part.value==="combined"?"translation":this.#n?.part.value;return(t&&this.#n?.axes.results[0][t])??null}#a(){return this.#i??Um(this.#o(),this.studio.store.value.unit)}#l(){let t=this.#r;if(!t||!Qu(t))return[];let e=t.velocity_ellipsoid.axes.at(-1);return e.length===6?[e]:[this.#n.part.value==="rotation"?[0,0,0,...e]:[...e,0,0,0]]}#c(){let t=this.#o();if(!this.#n||!t?.velocity_ellipsoid.axes.length)return"";let e=this.#n.part.value==="combined",i=e?"translation":this.#n.part.value,n=this.#n.axes.spaces.find(l=>l.part===i),{velocity:r,force:o}=this.#a(),a=(l,c)=>`1 ${l} is ${wi(c)} m long`;return[e?"Six dimensions have no picture: drawn is the translation. 1 rad counts as 1 m.":"",this.#s.velocity?`In the picture ${a(n.velocity_unit,r)}.`:"",this.#s.force?`In the picture ${a(n.force_unit,o)}.`:"",this.#s.force&&Bm(t.force_ellipsoid)?`The force is cut off at ${Ju} times its shortest axis.`:"",this.#i?"":"The scale follows the longest axis."].filter(Boolean).join(" ")}};var Vm={id:"jacobian",title:"Jacobian",open:(s,t)=>bc(s,t,()=>fw(s,t))},dw=250;function fw(s,t){let{store:e,api:i}=t,n={matrix:new bi(i,"the matrix"),axes:new bi(i,"the ellipsoids"),singularity:new bi(i,"the singularity")},r={matrix:new Ae,all:new Ae},o=new ss(e);o.host.classList.add("compact");let a=new Ac(e,S=>pw(o.host,S)),l=new Mc,c=new Lc(t),h=new Pc(S=>mw(t,S)),u=(S,v)=>w=>e.set(ra(e.value,S,w===v?null:w)),d=new _e("Axes and rates of the matrix",Us,u("jacobian.form",Us[0].value)),f=new _e("What counts",Tc,u("jacobian.part",Tc[0].value));s.append(ed("Joints",$u(t),o.host),ed("Jacobian",[d.host],r.matrix.host,a.host),ed("Ellipsoids at the tip",[f.host],c.host,l.host,c.words),ai("Singularity",h.host,r.all.host),...Object.values(n).map(S=>S.host));let m=S=>{r.all.show(null),r.matrix.show(S.matrix instanceof We?S.matrix:null),S.matrix instanceof We?a.clear():a.show(S.matrix,S.form),l.show(S.axes,S.part.value),h.show(S.report,S.axes.results[0][S.part.value]),c.show(S)},x=S=>r.all.show(ze(S)),p={matrix:n.matrix.api,axes:n.axes.api,singularity:n.singularity.api,other:i},[g,_]=[new Ye,new Ye],b=0,y=()=>{let[S,v]=[Mm(e.value),Tm(e.value)];d.show(S.value),f.show(v.value),o.update();let w=ee(e.value);clearTimeout(b),_.cancel(),w?.path&&(g.run(E=>Rm(p,w,S,v,E)).then(E=>E&&m(E)).catch(x),h.nearest(null),b=window.setTimeout(()=>{_.run(E=>Cm(p.singularity,w,v,E)).then(E=>E&&h.nearest(E,w.joints)).catch(x)},dw))},M=[e.watch(["model","base","tip","degrees"],()=>o.build()),e.watch(["model","base","tip","positions","options"],y),e.watch(["joint"],()=>a.mark()),e.watch(["joint","dark","unit","options"],()=>c.draw()),()=>g.cancel(),()=>_.cancel(),()=>clearTimeout(b),()=>c.close(),()=>e.set({joint:null})];return()=>{for(let S of M)S()}}function ed(s,t,...e){let i=ai(s,...e),n=P("div",{class:"bar"},i.firstElementChild,P("span",{class:"spring"}),...t);return i.prepend(n),i}function pw(s,t){[...s.querySelectorAll("input[type=range]")].find(i=>i.getAttribute("aria-label")===t)?.focus()}function mw({store:s},t){let e=ee(s.value);if(!e)return;let i=Object.fromEntries(e.joints.map(({name:n},r)=>[n,t[r]]));s.set({positions:{...s.value.positions,...i}})}var Vs=new So,Te=new C,ls=new C,ve=new Wt,Hm={X:new C(1,0,0),Y:new C(0,1,0),Z:new C(0,0,1)},id={type:"change"},Gm={type:"mouseDown",mode:null},Wm={type:"mouseUp",mode:null},Xm={type:"objectChange"},Fc=class extends Cs{constructor(t,e=null){super(void 0,e);let i=new sd(this);this._root=i;let n=new rd;this._gizmo=n,i.add(n);let r=new od;this._plane=r,i.add(r);let o=this;function a(b,y){let M=y;Object.defineProperty(o,b,{get:function(){return M!==void 0?M:y},set:function(S){M!==S&&(M=S,r[b]=S,n[b]=S,o.dispatchEvent({type:b+"-changed",value:S}),o.dispatchEvent(id))}}),o[b]=y,r[b]=y,n[b]=y}a("camera",t),a("object",void 0),a("enabled",!0),a("axis",null),a("mode","translate"),a("translationSnap",null),a("rotationSnap",null),a("scaleSnap",null),a("space","world"),a("size",1),this.viewport=null,a("dragging",!1),a("showX",!0),a("showY",!0),a("showZ",!0),a("showXY",!0),a("showYZ",!0),a("showXZ",!0),a("showXYZE",!0),a("showE",!0),a("minX",-1/0),a("maxX",1/0),a("minY",-1/0),a("maxY",1/0),a("minZ",-1/0),a("maxZ",1/0);let l=new C,c=new C,h=new Wt,u=new Wt,d=new C,f=new Wt,m=new C,x=new C,p=new C,g=0,_=new C;a("worldPosition",l),a("worldPositionStart",c),a("worldQuaternion",h),a("worldQuaternionStart",u),a("cameraPosition",d),a("cameraQuaternion",f),a("pointStart",m),a("pointEnd",x),a("rotationAxis",p),a("rotationAngle",g),a("eye",_),this._offset=new C,this._startNorm=new C,this._endNorm=new C,this._cameraScale=new C,this._parentPosition=new C,this._parentQuaternion=new Wt,this._parentQuaternionInv=new Wt,this._parentScale=new C,this._worldScaleStart=new C,this._worldQuaternionInv=new Wt,this._worldScale=new C,this._positionStart=new C,this._quaternionStart=new Wt,this._scaleStart=new C,this._getPointer=gw.bind(this),this._onPointerDown=yw.bind(this),this._onPointerHover=xw.bind(this),this._onPointerMove=_w.bind(this),this._onPointerUp=vw.bind(this),e!==null&&this.connect(e)}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointermove",this._onPointerHover),this.domElement.addEventListener("pointerup",this._onPointerUp),this.domElement.style.touchAction="none"}disconnect(){this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.removeEventListener("pointermove",this._onPointerHover),this.domElement.removeEventListener("pointermove",this._onPointerMove),this.domElement.removeEventListener("pointerup",this._onPointerUp),this.domElement.style.touchAction=""}getHelper(){return this._root}pointerHover(t){if(this.object===void 0||this.dragging===!0)return;t!==null&&Vs.setFromCamera(t,this.camera);let e=nd(this._gizmo.picker[this.mode],Vs);e?this.axis=e.object.name:this.axis=null}pointerDown(t){if(!(this.object===void 0||this.dragging===!0||t!=null&&t.button!==0)&&this.axis!==null){t!==null&&Vs.setFromCamera(t,this.camera);let e=nd(this._plane,Vs,!0);e&&(this.object.updateMatrixWorld(),this.object.parent.updateMatrixWorld(),this._positionStart.copy(this.object.position),this._quaternionStart.copy(this.object.quaternion),this._scaleStart.copy(this.object.scale),this.object.matrixWorld.decompose(this.worldPositionStart,this.worldQuaternionStart,this._worldScaleStart),this.pointStart.copy(e.point).sub(this.worldPositionStart)),this.dragging=!0,Gm.mode=this.mode,this.dispatchEvent(Gm)}}pointerMove(t){let e=this.axis,i=this.mode,n=this.object,r=this.space;if(i==="scale"?r="local":(e==="E"||e==="XYZE"||e==="XYZ")&&(r="world"),n===void 0||e===null||this.dragging===!1||t!==null&&t.button!==-1)return;t!==null&&Vs.setFromCamera(t,this.camera);let o=nd(this._plane,Vs,!0);if(o){if(this.pointEnd.copy(o.point).sub(this.worldPositionStart),i==="translate")this._offset.copy(this.pointEnd).sub(this.pointStart),r==="local"&&e!=="XYZ"&&this._offset.applyQuaternion(this._worldQuaternionInv),e.indexOf("X")===-1&&(this._offset.x=0),e.indexOf("Y")===-1&&(this._offset.y=0),e.indexOf("Z")===-1&&(this._offset.z=0),r==="local"&&e!=="XYZ"?this._offset.applyQuaternion(this._quaternionStart).divide(this._parentScale):this._offset.applyQuaternion(this._parentQuaternionInv).divide(this._parentScale),n.position.copy(this._offset).add(this._positionStart),this.translationSnap&&(r==="local"&&(n.position.applyQuaternion(ve.copy(this._quaternionStart).invert()),e.search("X")!==-1&&(n.position.x=Math.round(n.position.x/this.translationSnap)*this.translationSnap),e.search("Y")!==-1&&(n.position.y=Math.round(n.position.y/this.translationSnap)*this.translationSnap),e.search("Z")!==-1&&(n.position.z=Math.round(n.position.z/this.translationSnap)*this.translationSnap),n.position.applyQuaternion(this._quaternionStart)),r==="world"&&(n.getWorldPosition(Te),e.search("X")!==-1&&(Te.x=Math.round(Te.x/this.translationSnap)*this.translationSnap),e.search("Y")!==-1&&(Te.y=Math.round(Te.y/this.translationSnap)*this.translationSnap),e.search("Z")!==-1&&(Te.z=Math.round(Te.z/this.translationSnap)*this.translationSnap),n.position.copy(n.parent.worldToLocal(Te)))),n.position.x=Math.max(this.minX,Math.min(this.maxX,n.position.x)),n.position.y=Math.max(this.minY,Math.min(this.maxY,n.position.y)),n.position.z=Math.max(this.minZ,Math.min(this.maxZ,n.position.z));else if(i==="scale"){if(e.search("XYZ")!==-1){let a=this.pointEnd.length()/this.pointStart.length();this.pointEnd.dot(this.pointStart)<0&&(a*=-1),ls.set(a,a,a)}else Te.copy(this.pointStart),ls.copy(this.pointEnd),Te.applyQuaternion(this._worldQuaternionInv),ls.applyQuaternion(this._worldQuaternionInv),ls.divide(Te),e.search("X")===-1&&(ls.x=1),e.search("Y")===-1&&(ls.y=1),e.search("Z")===-1&&(ls.z=1);n.scale.copy(this._scaleStart).multiply(ls),this.scaleSnap&&(e.search("X")!==-1&&(n.scale.x=Math.round(n.scale.x/this.scaleSnap)*this.scaleSnap||this.scaleSnap),e.search("Y")!==-1&&(n.scale.y=Math.round(n.scale.y/this.scaleSnap)*this.scaleSnap||this.scaleSnap),e.search("Z")!==-1&&(n.scale.z=Math.round(n.scale.z/this.scaleSnap)*this.scaleSnap||this.scaleSnap))}else if(i==="rotate"){this._offset.copy(this.pointEnd).sub(this.pointStart);let a=20/this.worldPosition.distanceTo(Te.setFromMatrixPosition(this.camera.matrixWorld)),l=!1;e==="XYZE"?(this.rotationAxis.copy(this._offset).cross(this.eye).normalize(),this.rotationAngle=this._offset.dot(Te.copy(this.rotationAxis).cross(this.eye))*a):(e==="X"||e==="Y"||e==="Z")&&(this.rotationAxis.copy(Hm[e]),Te.copy(Hm[e]),r==="local"&&Te.applyQuaternion(this.worldQuaternion),Te.cross(this.eye),Te.length()===0?l=!0:this.rotationAngle=this._offset.dot(Te.normalize())*a),(e==="E"||l)&&(this.rotationAxis.copy(this.eye),this.rotationAngle=this.pointEnd.angleTo(this.pointStart),this._startNorm.copy(this.pointStart).normalize(),this._endNorm.copy(this.pointEnd).normalize(),this.rotationAngle*=this._endNorm.cross(this._startNorm).dot(this.eye)<0?1:-1),this.rotationSnap&&(this.rotationAngle=Math.round(this.rotationAngle/this.rotationSnap)*this.rotationSnap),r==="local"&&e!=="E"&&e!=="XYZE"?(n.quaternion.copy(this._quaternionStart),n.quaternion.multiply(ve.setFromAxisAngle(this.rotationAxis,this.rotationAngle)).normalize()):(this.rotationAxis.applyQuaternion(this._parentQuaternionInv),n.quaternion.copy(ve.setFromAxisAngle(this.rotationAxis,this.rotationAngle)),n.quaternion.multiply(this._quaternionStart).normalize())}this.dispatchEvent(id),this.dispatchEvent(Xm)}}pointerUp(t){t!==null&&t.button!==0||(this.dragging&&this.axis!==null&&(Wm.mode=this.mode,this.dispatchEvent(Wm)),this.dragging=!1,this.axis=null)}dispose(){this.disconnect(),this._root.dispose()}attach(t){return this.object=t,this._root.visible=!0,this}detach(){return this.object=void 0,this.axis=null,this._root.visible=!1,this}reset(){this.enabled&&this.dragging&&(this.object.position.copy(this._positionStart),this.object.quaternion.copy(this._quaternionStart),this.object.scale.copy(this._scaleStart),this.dispatchEvent(id),this.dispatchEvent(Xm),this.pointStart.copy(this.pointEnd))}getRaycaster(){return Vs}getMode(){return this.mode}setMode(t){this.mode=t}setTranslationSnap(t){this.translationSnap=t}setRotationSnap(t){this.rotationSnap=t}setScaleSnap(t){this.scaleSnap=t}setSize(t){this.size=t}setSpace(t){this.space=t}setColors(t,e,i,n){let r=this._gizmo.materialLib;r.xAxis.color.set(t),r.yAxis.color.set(e),r.zAxis.color.set(i),r.active.color.set(n),r.xAxisTransparent.color.set(t),r.yAxisTransparent.color.set(e),r.zAxisTransparent.color.set(i),r.activeTransparent.color.set(n),r.xAxis._color&&r.xAxis._color.set(t),r.yAxis._color&&r.yAxis._color.set(e),r.zAxis._color&&r.zAxis._color.set(i),r.active._color&&r.active._color.set(n),r.xAxisTransparent._color&&r.xAxisTransparent._color.set(t),r.yAxisTransparent._color&&r.yAxisTransparent._color.set(e),r.zAxisTransparent._color&&r.zAxisTransparent._color.set(i),r.activeTransparent._color&&r.activeTransparent._color.set(n)}};function gw(s){if(this.domElement.ownerDocument.pointerLockElement)return{x:0,y:0,button:s.button};{let t=this.domElement.getBoundingClientRect(),e=this.viewport,i,n,r,o;return e!==null?(i=e.x,n=t.height-e.y-e.w,r=e.z,o=e.w):(i=0,n=0,r=t.width,o=t.height),{x:(s.clientX-t.left-i)/r*2-1,y:-(s.clientY-t.top-n)/o*2+1,button:s.button}}}function xw(s){if(this.enabled)switch(s.pointerType){case"mouse":case"pen":this.pointerHover(this._getPointer(s));break}}function yw(s){this.enabled&&(document.pointerLockElement||this.domElement.setPointerCapture(s.pointerId),this.domElement.addEventListener("pointermove",this._onPointerMove),this.pointerHover(this._getPointer(s)),this.pointerDown(this._getPointer(s)))}function _w(s){this.enabled&&this.pointerMove(this._getPointer(s))}function vw(s){this.enabled&&(this.domElement.releasePointerCapture(s.pointerId),this.domElement.removeEventListener("pointermove",this._onPointerMove),this.pointerUp(this._getPointer(s)))}function nd(s,t,e){let i=t.intersectObject(s,!0);for(let n=0;n<i.length;n++)if(i[n].object.visible||e)return i[n];return!1}var Nc=new Qe,de=new C(0,1,0),qm=new C(0,0,0),jm=new wt,Dc=new Wt,kc=new Wt,mn=new C,Oc=new wt,Zo=new C(1,0,0),Hs=new C(0,1,0),Jo=new C(0,0,1),zc=new C,Yo=new C,$o=new C,sd=class extends te{constructor(t){super(),this.isTransformControlsRoot=!0,this.controls=t,this.visible=!1}updateMatrixWorld(t){let e=this.controls;e.object!==void 0&&(e.object.updateMatrixWorld(),e.object.parent===null?console.error("TransformControls: The attached 3D object must be a part of the scene graph."):e.object.parent.matrixWorld.decompose(e._parentPosition,e._parentQuaternion,e._parentScale),e.object.matrixWorld.decompose(e.worldPosition,e.worldQuaternion,e._worldScale),e._parentQuaternionInv.copy(e._parentQuaternion).invert(),e._worldQuaternionInv.copy(e.worldQuaternion).invert()),e.camera.updateMatrixWorld(),e.camera.matrixWorld.decompose(e.cameraPosition,e.cameraQuaternion,e._cameraScale),e.camera.isOrthographicCamera?e.camera.getWorldDirection(e.eye).negate():e.eye.copy(e.cameraPosition).sub(e.worldPosition).normalize(),this.parent&&(Oc.copy(this.parent.matrixWorld).invert(),Oc.decompose(this.position,this.quaternion,this.scale)),super.updateMatrixWorld(t)}dispose(){this.traverse(function(t){t.geometry&&t.geometry.dispose(),t.material&&t.material.dispose()})}},rd=class extends te{constructor(){super(),this.isTransformControlsGizmo=!0,this.type="TransformControlsGizmo";let t=new ti({depthTest:!1,depthWrite:!1,fog:!1,toneMapped:!1,transparent:!0}),e=new ei({depthTest:!1,depthWrite:!1,fog:!1,toneMapped:!1,transparent:!0}),i=t.clone();i.opacity=.15;let n=e.clone();n.opacity=.5;let r=t.clone();r.color.setHex(16711680);let o=t.clone();o.color.setHex(65280);let a=t.clone();a.color.setHex(255);let l=t.clone();l.color.setHex(16711680),l.opacity=.5;let c=t.clone();c.color.setHex(65280),c.opacity=.5;let h=t.clone();h.color.setHex(255),h.opacity=.5;let u=t.clone();u.opacity=.25;let d=t.clone();d.color.setHex(16776960),d.opacity=.25;let f=t.clone();f.color.setHex(16776960);let m=t.clone();m.color.setHex(7895160),this.materialLib={xAxis:r,yAxis:o,zAxis:a,active:f,xAxisTransparent:l,yAxisTransparent:c,zAxisTransparent:h,activeTransparent:d};let x=new Me(0,.04,.1,12);x.translate(0,.05,0);let p=new ye(.08,.08,.08);p.translate(0,.04,0);let g=new ce;g.setAttribute("position",new Ft([0,0,0,1,0,0],3));let _=new Me(.0075,.0075,.5,3);_.translate(0,.25,0);function b(V,k){let B=new $i(V,.0075,3,64,k*Math.PI*2);return B.rotateY(Math.PI/2),B.rotateX(Math.PI/2),B}function y(){let V=new ce;return V.setAttribute("position",new Ft([0,0,0,1,1,1],3)),V}let M={X:[[new st(x,r),[.5,0,0],[0,0,-Math.PI/2]],[new st(x,r),[-.5,0,0],[0,0,Math.PI/2]],[new st(_,r),[0,0,0],[0,0,-Math.PI/2]]],Y:[[new st(x,o),[0,.5,0]],[new st(x,o),[0,-.5,0],[Math.PI,0,0]],[new st(_,o)]],Z:[[new st(x,a),[0,0,.5],[Math.PI/2,0,0]],[new st(x,a),[0,0,-.5],[-Math.PI/2,0,0]],[new st(_,a),null,[Math.PI/2,0,0]]],XYZ:[[new st(new Xn(.1,0),u),[0,0,0]]],XY:[[new st(new ye(.15,.15,.01),h),[.15,.15,0]]],YZ:[[new st(new ye(.15,.15,.01),l),[0,.15,.15],[0,Math.PI/2,0]]],XZ:[[new st(new ye(.15,.15,.01),c),[.15,0,.15],[-Math.PI/2,0,0]]]},S={X:[[new st(new Me(.2,0,.6,4),i),[.3,0,0],[0,0,-Math.PI/2]],[new st(new Me(.2,0,.6,4),i),[-.3,0,0],[0,0,Math.PI/2]]],Y:[[new st(new Me(.2,0,.6,4),i),[0,.3,0]],[new st(new Me(.2,0,.6,4),i),[0,-.3,0],[0,0,Math.PI]]],Z:[[new st(new Me(.2,0,.6,4),i),[0,0,.3],[Math.PI/2,0,0]],[new st(new Me(.2,0,.6,4),i),[0,0,-.3],[-Math.PI/2,0,0]]],XYZ:[[new st(new Xn(.2,0),i)]],XY:[[new st(new ye(.2,.2,.01),i),[.15,.15,0]]],YZ:[[new st(new ye(.2,.2,.01),i),[0,.15,.15],[0,Math.PI/2,0]]],XZ:[[new st(new ye(.2,.2,.01),i),[.15,0,.15],[-Math.PI/2,0,0]]]},v={START:[[new st(new Xn(.01,2),n),null,null,null,"helper"]],END:[[new st(new Xn(.01,2),n),null,null,null,"helper"]],DELTA:[[new Ge(y(),n),null,null,null,"helper"]],X:[[new Ge(g,n),[-1e3,0,0],null,[1e6,1,1],"helper"]],Y:[[new Ge(g,n),[0,-1e3,0],[0,0,Math.PI/2],[1e6,1,1],"helper"]],Z:[[new Ge(g,n),[0,0,-1e3],[0,-Math.PI/2,0],[1e6,1,1],"helper"]]},w={XYZE:[[new st(b(.5,1),m),null,[0,Math.PI/2,0]]],X:[[new st(b(.5,.5),r)]],Y:[[new st(b(.5,.5),o),null,[0,0,-Math.PI/2]]],Z:[[new st(b(.5,.5),a),null,[0,Math.PI/2,0]]],E:[[new st(b(.75,1),d),null,[0,Math.PI/2,0]]]},E={AXIS:[[new Ge(g,n),[-1e3,0,0],null,[1e6,1,1],"helper"]]},R={XYZE:[[new st(new Cn(.25,10,8),i)]],X:[[new st(new $i(.5,.1,4,24),i),[0,0,0],[0,-Math.PI/2,-Math.PI/2]]],Y:[[new st(new $i(.5,.1,4,24),i),[0,0,0],[Math.PI/2,0,0]]],Z:[[new st(new $i(.5,.1,4,24),i),[0,0,0],[0,0,-Math.PI/2]]],E:[[new st(new $i(.75,.1,2,24),i)]]},L={X:[[new st(p,r),[.5,0,0],[0,0,-Math.PI/2]],[new st(_,r),[0,0,0],[0,0,-Math.PI/2]],[new st(p,r),[-.5,0,0],[0,0,Math.PI/2]]],Y:[[new st(p,o),[0,.5,0]],[new st(_,o)],[new st(p,o),[0,-.5,0],[0,0,Math.PI]]],Z:[[new st(p,a),[0,0,.5],[Math.PI/2,0,0]],[new st(_,a),[0,0,0],[Math.PI/2,0,0]],[new st(p,a),[0,0,-.5],[-Math.PI/2,0,0]]],XY:[[new st(new ye(.15,.15,.01),h),[.15,.15,0]]],YZ:[[new st(new ye(.15,.15,.01),l),[0,.15,.15],[0,Math.PI/2,0]]],XZ:[[new st(new ye(.15,.15,.01),c),[.15,0,.15],[-Math.PI/2,0,0]]],XYZ:[[new st(new ye(.1,.1,.1),u)]]},D={X:[[new st(new Me(.2,0,.6,4),i),[.3,0,0],[0,0,-Math.PI/2]],[new st(new Me(.2,0,.6,4),i),[-.3,0,0],[0,0,Math.PI/2]]],Y:[[new st(new Me(.2,0,.6,4),i),[0,.3,0]],[new st(new Me(.2,0,.6,4),i),[0,-.3,0],[0,0,Math.PI]]],Z:[[new st(new Me(.2,0,.6,4),i),[0,0,.3],[Math.PI/2,0,0]],[new st(new Me(.2,0,.6,4),i),[0,0,-.3],[-Math.PI/2,0,0]]],XY:[[new st(new ye(.2,.2,.01),i),[.15,.15,0]]],YZ:[[new st(new ye(.2,.2,.01),i),[0,.15,.15],[0,Math.PI/2,0]]],XZ:[[new st(new ye(.2,.2,.01),i),[.15,0,.15],[-Math.PI/2,0,0]]],XYZ:[[new st(new ye(.2,.2,.2),i),[0,0,0]]]},U={X:[[new Ge(g,n),[-1e3,0,0],null,[1e6,1,1],"helper"]],Y:[[new Ge(g,n),[0,-1e3,0],[0,0,Math.PI/2],[1e6,1,1],"helper"]],Z:[[new Ge(g,n),[0,0,-1e3],[0,-Math.PI/2,0],[1e6,1,1],"helper"]]};function N(V){let k=new te;for(let B in V)for(let Y=V[B].length;Y--;){let H=V[B][Y][0].clone(),$=V[B][Y][1],Z=V[B][Y][2],ct=V[B][Y][3],ut=V[B][Y][4];H.name=B,H.tag=ut,$&&H.position.set($[0],$[1],$[2]),Z&&H.rotation.set(Z[0],Z[1],Z[2]),ct&&H.scale.set(ct[0],ct[1],ct[2]),H.updateMatrix();let G=H.geometry.clone();G.applyMatrix4(H.matrix),H.geometry=G,H.renderOrder=1/0,H.position.set(0,0,0),H.rotation.set(0,0,0),H.scale.set(1,1,1),k.add(H)}return k}this.gizmo={},this.picker={},this.helper={},this.add(this.gizmo.translate=N(M)),this.add(this.gizmo.rotate=N(w)),this.add(this.gizmo.scale=N(L)),this.add(this.picker.translate=N(S)),this.add(this.picker.rotate=N(R)),this.add(this.picker.scale=N(D)),this.add(this.helper.translate=N(v)),this.add(this.helper.rotate=N(E)),this.add(this.helper.scale=N(U)),this.picker.translate.visible=!1,this.picker.rotate.visible=!1,this.picker.scale.visible=!1}updateMatrixWorld(t){let i=(this.mode==="scale"?"local":this.space)==="local"?this.worldQuaternion:kc;this.gizmo.translate.visible=this.mode==="translate",this.gizmo.rotate.visible=this.mode==="rotate",this.gizmo.scale.visible=this.mode==="scale",this.helper.translate.visible=this.mode==="translate",this.helper.rotate.visible=this.mode==="rotate",this.helper.scale.visible=this.mode==="scale";let n=[];n=n.concat(this.picker[this.mode].children),n=n.concat(this.gizmo[this.mode].children),n=n.concat(this.helper[this.mode].children);for(let r=0;r<n.length;r++){let o=n[r];o.visible=!0,o.rotation.set(0,0,0),o.position.copy(this.worldPosition);let a;if(this.camera.isOrthographicCamera?a=(this.camera.top-this.camera.bottom)/this.camera.zoom:a=this.worldPosition.distanceTo(this.cameraPosition)*Math.min(1.9*Math.tan(Math.PI*this.camera.fov/360)/this.camera.zoom,7),o.scale.set(1,1,1).multiplyScalar(a*this.size/4),o.tag==="helper"){o.visible=!1,o.name==="AXIS"?(o.visible=!!this.axis,this.axis==="X"&&(ve.setFromEuler(Nc.set(0,0,0)),o.quaternion.copy(i).multiply(ve),Math.abs(de.copy(Zo).applyQuaternion(i).dot(this.eye))>.9&&(o.visible=!1)),this.axis==="Y"&&(ve.setFromEuler(Nc.set(0,0,Math.PI/2)),o.quaternion.copy(i).multiply(ve),Math.abs(de.copy(Hs).applyQuaternion(i).dot(this.eye))>.9&&(o.visible=!1)),this.axis==="Z"&&(ve.setFromEuler(Nc.set(0,Math.PI/2,0)),o.quaternion.copy(i).multiply(ve),Math.abs(de.copy(Jo).applyQuaternion(i).dot(this.eye))>.9&&(o.visible=!1)),this.axis==="XYZE"&&(ve.setFromEuler(Nc.set(0,Math.PI/2,0)),de.copy(this.rotationAxis),o.quaternion.setFromRotationMatrix(jm.lookAt(qm,de,Hs)),o.quaternion.multiply(ve),o.visible=this.dragging),this.axis==="E"&&(o.visible=!1)):o.name==="START"?(o.position.copy(this.worldPositionStart),o.visible=this.dragging):o.name==="END"?(o.position.copy(this.worldPosition),o.visible=this.dragging):o.name==="DELTA"?(o.position.copy(this.worldPositionStart),o.quaternion.copy(this.worldQuaternionStart),Te.set(1e-10,1e-10,1e-10).add(this.worldPositionStart).sub(this.worldPosition).multiplyScalar(-1),Te.applyQuaternion(this.worldQuaternionStart.clone().invert()),o.scale.copy(Te),o.visible=this.dragging):(o.quaternion.copy(i),this.dragging?o.position.copy(this.worldPositionStart):o.position.copy(this.worldPosition),this.axis&&(o.visible=this.axis.search(o.name)!==-1));continue}o.quaternion.copy(i),this.mode==="translate"||this.mode==="scale"?(o.name==="X"&&Math.abs(de.copy(Zo).applyQuaternion(i).dot(this.eye))>.99&&(o.scale.set(1e-10,1e-10,1e-10),o.visible=!1),o.name==="Y"&&Math.abs(de.copy(Hs).applyQuaternion(i).dot(this.eye))>.99&&(o.scale.set(1e-10,1e-10,1e-10),o.visible=!1),o.name==="Z"&&Math.abs(de.copy(Jo).applyQuaternion(i).dot(this.eye))>.99&&(o.scale.set(1e-10,1e-10,1e-10),o.visible=!1),o.name==="XY"&&Math.abs(de.copy(Jo).applyQuaternion(i).dot(this.eye))<.2&&(o.scale.set(1e-10,1e-10,1e-10),o.visible=!1),o.name==="YZ"&&Math.abs(de.copy(Zo).applyQuaternion(i).dot(this.eye))<.2&&(o.scale.set(1e-10,1e-10,1e-10),o.visible=!1),o.name==="XZ"&&Math.abs(de.copy(Hs).applyQuaternion(i).dot(this.eye))<.2&&(o.scale.set(1e-10,1e-10,1e-10),o.visible=!1)):this.mode==="rotate"&&(Dc.copy(i),de.copy(this.eye).applyQuaternion(ve.copy(i).invert()),o.name.search("E")!==-1&&o.quaternion.setFromRotationMatrix(jm.lookAt(this.eye,qm,Hs)),o.name==="X"&&(ve.setFromAxisAngle(Zo,Math.atan2(-de.y,de.z)),ve.multiplyQuaternions(Dc,ve),o.quaternion.copy(ve)),o.name==="Y"&&(ve.setFromAxisAngle(Hs,Math.atan2(de.x,de.z)),ve.multiplyQuaternions(Dc,ve),o.quaternion.copy(ve)),o.name==="Z"&&(ve.setFromAxisAngle(Jo,Math.atan2(de.y,de.x)),ve.multiplyQuaternions(Dc,ve),o.quaternion.copy(ve))),o.visible=o.visible&&(o.name.indexOf("X")===-1||this.showX),o.visible=o.visible&&(o.name.indexOf("Y")===-1||this.showY),o.visible=o.visible&&(o.name.indexOf("Z")===-1||this.showZ),o.visible=o.visible&&(o.name.indexOf("E")===-1||this.showX&&this.showY&&this.showZ),o.visible=o.visible&&(o.name.indexOf("XY")===-1||this.showXY),o.visible=o.visible&&(o.name.indexOf("YZ")===-1||this.showYZ),o.visible=o.visible&&(o.name.indexOf("XZ")===-1||this.showXZ),o.visible=o.visible&&(o.name!=="E"||this.showE),o.visible=o.visible&&(o.name!=="XYZE"||this.showXYZE),o.material._color=o.material._color||o.material.color.clone(),o.material._opacity=o.material._opacity||o.material.opacity,o.material.color.copy(o.material._color),o.material.opacity=o.material._opacity,this.enabled&&this.axis&&(o.name===this.axis?(o.material.color.copy(this.materialLib.active.color),o.material.opacity=1):this.axis.split("").some(function(l){return o.name===l})&&(o.material.color.copy(this.materialLib.active.color),o.material.opacity=1))}super.updateMatrixWorld(t)}},od=class extends st{constructor(){super(new ws(1e5,1e5,2,2),new ti({visible:!1,wireframe:!0,side:si,transparent:!0,opacity:.1,toneMapped:!1})),this.isTransformControlsPlane=!0,this.type="TransformControlsPlane"}updateMatrixWorld(t){let e=this.space;switch(this.position.copy(this.worldPosition),this.mode==="scale"&&(e="local"),zc.copy(Zo).applyQuaternion(e==="local"?this.worldQuaternion:kc),Yo.copy(Hs).applyQuaternion(e==="local"?this.worldQuaternion:kc),$o.copy(Jo).applyQuaternion(e==="local"?this.worldQuaternion:kc),de.copy(Yo),this.mode){case"translate":case"scale":switch(this.axis){case"X":de.copy(this.eye).cross(zc),mn.copy(zc).cross(de);break;case"Y":de.copy(this.eye).cross(Yo),mn.copy(Yo).cross(de);break;case"Z":de.copy(this.eye).cross($o),mn.copy($o).cross(de);break;case"XY":mn.copy($o);break;case"YZ":mn.copy(zc);break;case"XZ":de.copy($o),mn.copy(Yo);break;case"XYZ":case"E":mn.set(0,0,0);break}break;default:mn.set(0,0,0)}mn.length()===0?this.quaternion.copy(this.cameraQuaternion):(Oc.lookAt(Te.set(0,0,0),mn,de),this.quaternion.setFromRotationMatrix(Oc)),super.updateMatrixWorld(t)}};var Ym=["x","y","z"],bw=[...Ym,"rx","ry"],Sw=new Set(["auto","analytic"]);function Ur(s,t){let e=s?.method??"auto",i=s?.task??ww(t),n=t<=i.length;return{...s,method:e,task:i,respect_limits:s?.respect_limits??!0,solutions:ad(e)?s?.solutions??(n?"all":"one"):"one"}}function ad(s){return Sw.has(s)}function ww(s){return[...s>=6?ts:s===5?bw:Ym]}function $m(s,t,e){let{method:i,task:n,respect_limits:r,...o}=e;return{targets:[t],seeds:[s.configuration],...s.ends,...i!=="auto"&&{method:i},...n.length<ts.length&&{task:n},...!r&&{respect_limits:r},...o}}var Mw=.75,Uc=class{constructor(t,e,i){this.view=t;this.store=e;this.#t=new Fc(t.camera,t.canvas),this.#t.setSpace("local"),this.#t.setSize(Mw),this.#t.addEventListener("change",()=>t.draw()),this.#t.addEventListener("objectChange",()=>i.dragged(this.#o())),this.#t.addEventListener("dragging-changed",({value:n})=>{t.controls.enabled=!n,n||(this.#s(),i.dropped())}),this.#e.name="target handle",this.#t.attach(this.#e),t.scene.add(this.#e,this.#t.getHelper()),this.#n=[e.watch(["dark"],()=>this.#t.setColors(me("x"),me("y"),me("z"),me("axis"))),e.watch(["model","base","tip","target","inverse","positions"],()=>this.#s())]}view;store;#t;#e=new te;#i="translate";#n;get mode(){return this.#i}allows(t){return this.#r().some(e=>e.startsWith("r")===(t==="rotate"))}turnTo(t){let e=t==="rotate"?"translate":"rotate";return this.#i=this.allows(t)?t:e,this.#t.setMode(this.#i),this.#s(),this.#i}close(){for(let t of this.#n)t();this.view.controls.enabled=!0,this.view.scene.remove(this.#e,this.#t.getHelper()),this.#t.dispose(),this.view.draw()}#s(){let{target:t}=this.store.value,e=ee(this.store.value);if(this.#t.enabled=this.#t.getHelper().visible=e!==null&&t!==null,!e||!t||this.#t.dragging)return;let i=this.#r(),n=this.#i==="rotate";this.#t.showX=i.includes(n?"rx":"x"),this.#t.showY=i.includes(n?"ry":"y"),this.#t.showZ=i.includes(n?"rz":"z");let{showX:r,showY:o,showZ:a}=this.#t;this.#t.showE=this.#t.showXYZE=r&&o&&a;let l=e.model.link(e.base).matrixWorld;zn(this.#e,l.clone().multiply(Pe(t))),n||l.decompose(new C,this.#e.quaternion,new C),this.view.draw()}#r(){let t=ee(this.store.value)?.joints.length??0;return Ur(this.store.value.inverse,t).task}#o(){let t=ee(this.store.value),e=this.store.value.target;this.#e.updateMatrixWorld();let i=t.model.link(t.base).matrixWorld.clone().invert().multiply(this.#e.matrixWorld),n=this.#i==="rotate"?i:Pe(e).copyPosition(i);return di(n,Oo(e)??"rpy")}};var Tw=[{value:"auto",text:"Automatic"},{value:"analytic",text:"Closed form"},{value:"newton",text:"Newton"},{value:"gradient",text:"Gradient"},{value:"gradient_then_newton",text:"Gradient, then Newton"},{value:"damped_least_squares",text:"Damped least squares"}],Aw={x:"Position along the base's x axis",y:"Position along the base's y axis",z:"Position along the base's z axis",rx:"Rotation about the target's x axis",ry:"Rotation about the target's y axis",rz:"Rotation about the target's z axis"},Bc=class{constructor(t,e){this.store=t;this.#t=new _e("How many solutions",[{value:"one",text:"One"},{value:"all",text:"All"}],i=>this.#l({solutions:i})),this.#e=P("select",{class:"select","aria-label":"Method",onchange:()=>this.#l({method:this.#e.value})},...Tw.map(({value:i,text:n})=>P("option",{value:i},n))),this.#i=Ki("Within limits","Whether solutions must be within the limits of the joints",()=>this.#l({respect_limits:!this.#a().respect_limits}));for(let i of ts){let n=()=>this.#c(i);this.#n.set(i,Ki(i,Aw[i],n))}this.#s=this.#h("Position tolerance","length","position_tolerance"),this.#r=this.#h("Orientation tolerance","angle","orientation_tolerance"),this.host=P("div",{class:"ik-options"},P("div",{class:"bar"},this.#t.host,this.#e,this.#i),P("div",{class:"bar",role:"group","aria-label":"Directions that count"},P("span",{class:"field"},"Counts"),...this.#n.values()),P("div",{class:"bar tolerances"},P("span",{class:"field"},"Tolerances"),this.#s.input,P("span",{class:"unit"},"m"),this.#r.input,this.#o,P("span",{class:"spring"}),Vt("Solve again",e,{title:"Once more, from the posture on the screen"})))}store;host;#t;#e;#i;#n=new Map;#s;#r;#o=P("span",{class:"unit"});show({inverse:t,degrees:e}){let{solutions:i,method:n,respect_limits:r,task:o}=this.#a();this.#t.show(i),this.#t.allow("all",ad(n)?null:"This method follows one start to one solution"),this.#e.value=n,this.#i.setAttribute("aria-pressed",String(r));for(let[a,l]of this.#n)l.setAttribute("aria-pressed",String(o.includes(a)));this.#s.set(t?.position_tolerance??null),this.#r.set(t?.orientation_tolerance??null),this.#o.textContent=Bi("angle",e),this.#r.input.placeholder=e?"0.00006":"0.000001"}#a(){let{inverse:t}=this.store.value;return Ur(t,ee(this.store.value)?.joints.length??6)}#l(t){this.store.set({inverse:{...this.store.value.inverse,...t}})}#c(t){let{task:e}=this.#a(),i=ts.filter(n=>n===t!==e.includes(n));i.length&&this.#l({task:i})}#h(t,e,i){let n=new Vi({label:t,kind:e,degrees:()=>this.store.value.degrees,decimals:14,optional:!0,change:r=>{let{[i]:o,...a}=this.store.value.inverse??{};this.store.set({inverse:r===null?a:{...a,[i]:r}})}});return n.input.placeholder="0.000001",n}};var Ko=class{constructor(t,e,i,n){this.model=t;let r={polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:1};this.#t=new Ms({color:me(i),transparent:!0,opacity:n,...r}),this.#e=t.moving(e).map(o=>{let a=new st(o.geometry,this.#t);return a.matrixAutoUpdate=!1,{from:o,copy:a}}),this.group.add(...this.#e.map(({copy:o})=>o))}model;group=new Kt;#t;#e;place(t,e){this.model.place(t);for(let{from:i,copy:n}of this.#e)n.matrix.copy(i.matrixWorld);this.model.place(e)}paint(t,e){this.#t.color=me(t),this.#t.opacity=e}remove(){this.group.removeFromParent(),this.#t.dispose()}};function Qo(s,t){return Math.hypot(...s.configuration.map((e,i)=>e-t[i]))}function Zm(s){return[...new Set(s.joints.map(e=>e.type==="prismatic"?"m":"rad"))].join(", ")}var Br=class{#t;#e=new Set;constructor(t){this.#t=t}get value(){return this.#t}set(t){let e=this.#t;this.#t={...e,...t};let i=Object.keys(t).filter(n=>e[n]!==t[n]);if(i.length!==0)for(let n of[...this.#e])this.#e.has(n)&&n.keys.some(r=>i.includes(r))&&n.react()}watch(t,e){let i={keys:t,react:()=>e(this.#t)};return this.#e.add(i),i.react(),()=>this.#e.delete(i)}};var ld={answer:null,result:null,problem:null,isBusy:!1,isCancelled:!1,isFollowing:!1,pointed:null},Vc=class{constructor(t,e){this.api=t;this.store=e}api;store;outcome=new Br(ld);#t=new Ye;#e=!1;#i=!1;#n=!1;#s=0;async solve(){this.#r(),this.outcome.set({isFollowing:!1}),await this.#l(t=>t)}follow(t){clearTimeout(this.#s),this.outcome.set({isFollowing:!0}),this.#i=!0,this.#n=!1,this.store.set({target:t}),this.#o()}rest(t=0){clearTimeout(this.#s),this.#s=window.setTimeout(()=>{this.#n=!0,this.#e||this.solve()},t)}cancel(){this.#r(),this.#t.cancel(),this.outcome.set({isBusy:!1,isCancelled:!0,isFollowing:!1})}#r(){clearTimeout(this.#s),this.#i=!1,this.#n=!1}forget(){this.cancel(),this.outcome.set(ld)}async#o(){if(!this.#e){for(this.#e=!0;this.#i;)this.#i=!1,await this.#l(t=>({...t,solutions:"one"})),this.outcome.value.isFollowing&&this.#a();this.#e=!1,this.#n&&await this.solve()}}#a(){let{answer:t,result:e}=this.outcome.value,i=e?.solutions[0];t&&i&&this.store.set({positions:Gs(this.store.value,t.joint_names,i.joint_positions)})}async#l(t){let e=this.store.value,i=ee(e);if(!i?.path||!e.target)return;let n=$m(i,e.target,t(Ur(e.inverse,i.joints.length)));this.outcome.set({isBusy:!0,isCancelled:!1});try{let r=await this.#t.run(o=>this.#c(i,n,o));r&&this.outcome.set({answer:r,result:r.results[0],problem:null,isBusy:!1,pointed:null})}catch(r){this.#r(),this.outcome.set({...ld,problem:ze(r)})}}#c(t,e,i){return this.api.post(`${t.path}/ik`,e,i)}};function Gs(s,t,e){return{...s.positions,...Object.fromEntries(t.map((i,n)=>[i,e[n]]))}}var ta=8,Jm=.24,Ew=.7,Rw=.1,Cw=.5,Km=.001,Hc=class{constructor(t,e,i){this.view=t;this.store=e;this.outcome=i;t.scene.add(this.#t,this.#e),this.#s=[e.watch(["model","base","target","unit","dark"],n=>this.#r(n)),e.watch(["model","meshes","dark"],()=>this.#o()),i.watch(["result","isFollowing"],()=>this.#o()),i.watch(["pointed"],()=>this.#h()),e.watch(["positions"],()=>this.#h())]}view;store;outcome;#t=new Kt;#e=new Kt;#i=new Map;#n=null;#s;close(){for(let t of this.#s)t();this.#u(),os(this.#e),this.view.scene.remove(this.#t,this.#e),this.view.draw()}#r(t){os(this.#e);let e=ee(t);e&&t.target&&(this.#e.add(qo(t.unit*.8)),zn(this.#e,e.model.link(e.base).matrixWorld.clone().multiply(Pe(t.target)))),this.view.draw()}#o(){this.#u();let{result:t,isFollowing:e}=this.outcome.value,i=this.#a();if(i&&t){if(!e)for(let n of t.solutions.slice(0,ta).keys())this.#l(i,n);t.nearest&&(this.#n=new Ko(i.model,i.joints,"bad",Cw),this.#n.group.name="nearest",this.#c(this.#n,t.nearest.joint_positions))}this.#h()}#a(){let t=ee(this.store.value),e=this.outcome.value.answer?.joint_names.join();return t&&t.joints.map(i=>i.name).join()===e?t:null}#l(t,e){let i=new Ko(t.model,t.joints,"accent",Jm);i.group.name=`ghost ${e}`,this.#i.set(e,i),this.#c(i,this.outcome.value.result.solutions[e].joint_positions)}#c(t,e){let{positions:i}=this.store.value;t.place(Gs(this.store.value,this.outcome.value.answer.joint_names,e),i),this.#t.add(t.group)}#h(){let{pointed:t,result:e}=this.outcome.value,i=this.#a();if(i&&e){t!==null&&e.solutions[t]&&!this.#i.has(t)&&this.#l(i,t);for(let[n,r]of this.#i){let o=n===t;r.paint("accent",o?Ew:t===null?Jm:Rw);let a=Qo(i,e.solutions[n].joint_positions)<Km;r.group.visible=!a&&(o||n<ta)}this.#n&&e.nearest&&(this.#n.group.visible=Qo(i,e.nearest.joint_positions)>Km)}this.view.draw()}#u(){for(let t of this.#i.values())t.remove();this.#i.clear(),this.#n?.remove(),this.#n=null}};function Gc({position_error:s,orientation_error:t},e){let i=[];return e.some(n=>n.length===1)&&i.push(`${Qm(s)} m`),e.some(n=>n.length===2)&&i.push(`${Qm(t)} rad`),i.join(", ")}function Qm(s){return s!==0&&s<.001?Qi(s):Si(s,4)}var Pw=1e-6,Wc=class{constructor(t,e){this.store=t;this.outcome=e}store;outcome;host=P("ul",{class:"solutions","aria-label":"Solutions"});#t=[];#e=null;show(){let{result:t}=this.outcome.value,e=ee(this.store.value);if(t!==this.#e&&this.#i(t),!!e)for(let i of this.#t)Iw(i,e,this.store.value.degrees)}#i(t){this.#e=t,this.#t=(t?.solutions??[]).map((e,i)=>this.#n(e,i)),this.host.hidden=this.#t.length===0,this.host.replaceChildren(...this.#t.map(({host:e})=>P("li",{},e)))}#n(t,e){let i=a=>()=>this.outcome.set({pointed:a}),n=P("span",{class:"solution-joints"}),r=P("span",{class:"solution-distance"}),o=P("button",{type:"button",class:"solution",title:"Move the robot here",onclick:()=>this.#s(t),onpointerenter:i(e),onpointerleave:i(null),onfocus:i(e),onblur:i(null)},P("span",{class:"solution-name"},Lw(t,e)),r,n,P("span",{class:"solution-facts"},Nw(t,this.outcome.value.answer.task)));return{solution:t,host:o,numbers:n,distance:r}}#s({joint_positions:t}){let e=this.outcome.value.answer.joint_names;this.store.set({positions:Gs(this.store.value,e,t)})}};function Iw({solution:s,host:t,numbers:e,distance:i},n,r){let o=Qo(n,s.joint_positions),a=o<Pw;t.setAttribute("aria-current",String(a)),t.dataset.distance=String(o),i.textContent=a?"the robot is here":`${Si(o,2)} ${Zm(n)} away`,e.replaceChildren(...s.joint_positions.map((l,c)=>{let u=n.joints[c]?.type==="prismatic"||!r?Si(l,3):`${Si(l*180/Math.PI,1)}°`;return P("span",{title:n.joints[c]?.name},u)}))}function Lw({branch:s,free_joints:t},e){let i=Object.entries(s??{}).map(([n,r])=>`${n} ${String(r).replaceAll("_"," ")}`);return t?.length&&i.push(`free: ${t.join(", ")}`),i.length?i.join(" · "):`Solution ${e+1}`}function Nw(s,t){let{method:e,iterations:i,restarts:n,position_error:r,orientation_error:o}=s,a=[e.replaceAll("_"," ")];return i&&a.push(`${i} ${i===1?"iteration":"iterations"}`),n&&a.push(`${n} ${n===1?"start":"starts"} before`),`${a.join(", ")} · ${Gc({position_error:r,orientation_error:o},t)} off`}var Dw={position:["x","y","z"],quaternion_xyzw:["qx","qy","qz","qw"],quaternion_wxyz:["qw","qx","qy","qz"],rpy:["roll","pitch","yaw"],zyz:["φ","θ","ψ"],rotation_vector:["rx","ry","rz"],rotation:[],matrix:[]},zw=.01,kw=Math.PI/180,tg=.01,Xc=class{constructor(t){this.events=t;this.#n=P("select",{class:"select","aria-label":"Notation of the orientation",onchange:()=>this.#t&&t.typed(di(Pe(this.#t),this.#n.value))},...Pr.map(({format:e,title:i})=>P("option",{value:e},i))),this.host.append(this.#s)}events;host=P("div",{class:"target"});#t=null;#e=null;#i=[];#n;#s=P("div",{class:"target-rows"});#r=!1;get format(){return this.#e??"rpy"}show(t){this.#t=t;let e=Oo(t)??"rpy";(e!==this.#e||this.events.degrees()!==this.#r)&&this.#o(e);for(let{field:i,read:n}of this.#i)i.set(n(t))}#o(t){let e=document.activeElement===this.#n;this.#e=t,this.#r=this.events.degrees(),this.#n.value=t,this.#i=[];let i=[];if(t!=="matrix"&&i.push(this.#a(P("span",{},"Position"),"position","length","m")),t==="rotation"||t==="matrix"){let n=t==="matrix"?4:3;for(let r of[0,1,2]){let o=Array.from({length:n},(a,l)=>this.#l(t,r,l));i.push(eg(r===0?this.#n:null,o,t==="matrix"?"m":""))}}else{let n=Kl.has(t),r=n?"angle":"length";i.push(this.#a(this.#n,t,r,n?Bi(r,this.#r):""))}this.#s.replaceChildren(...i),e&&this.#n.focus()}#a(t,e,i,n){let r=Dw[e].map((o,a)=>this.#c(`Target ${o}`,i,n?i==="angle"?kw:zw:tg,{read:l=>l[e][a],write:(l,c)=>({...l,[e]:l[e].with(a,c)})}));return eg(t,r,n)}#l(t,e,i){return this.#c(`Target row ${e+1}, column ${i+1}`,"length",tg,{read:n=>n[t][e][i],write:(n,r)=>({...n,[t]:n[t].with(e,n[t][e].with(i,r))})})}#c(t,e,i,{read:n,write:r}){let o=l=>c=>{c!==null&&this.#t&&n(this.#t)!==c&&l(r(this.#t,c))},a=new Vi({label:t,kind:e,degrees:this.events.degrees,decimals:4,change:o(this.events.typed),step:{by:i,take:o(this.events.nudged)}});return this.#i.push({field:a,read:n}),a}};function eg(s,t,e){return P("div",{class:"target-row"},P("span",{class:"target-title"},s),P("span",{class:"target-fields"},...t.map(i=>i.input)),P("span",{class:"unit"},e))}var Fw={unreachable:"Out of reach",outside_limits:"Only outside the limits of the joints",singular:"Stuck at a singularity",not_converged:"Not converged"},Ow=200,qc=class{constructor(t,e){this.store=t;this.solver=e;this.#i=Vt("Cancel",()=>e.cancel(),{class:"button small",hidden:!0}),this.host=P("div",{class:"verdict"},P("div",{class:"bar"},this.#t,this.#i),this.#e)}store;solver;host;#t=P("p",{class:"verdict-summary",role:"status"});#e=P("div",{class:"verdict-failure",hidden:!0});#i;#n=0;show(){let t=this.solver.outcome.value;if(clearTimeout(this.#n),t.isBusy&&!t.isFollowing){this.#n=window.setTimeout(()=>this.#s(),Ow);return}this.#i.hidden=!0,this.#t.textContent=Uw(t);let{result:e}=t,i=e!==null&&e.status!=="solved";this.#e.hidden=!i,this.#e.replaceChildren(...i?this.#r(e):[])}close(){clearTimeout(this.#n)}#s(){this.#t.textContent="Solving …",this.#i.hidden=!1}#r(t){let{nearest:e,reason:i}=t,n=[P("strong",{},Fw[t.status])];if(i&&n.push(P("p",{},`${i[0].toUpperCase()}${i.slice(1)}.`)),e){let r=`${Gc(e,this.solver.outcome.value.answer.task)} off`,o=()=>{let a=this.solver.outcome.value.answer.joint_names;this.store.set({positions:Gs(this.store.value,a,e.joint_positions)})};n.push(P("div",{class:"bar"},Vt("Move to nearest",o,{class:"button"}),P("span",{class:"small"},r)))}return n}};function Uw({result:s,answer:t,isCancelled:e,isFollowing:i}){if(e)return"Cancelled.";if(!s||s.status!=="solved")return"";let n=s.solutions.length,r=[];return s.complete===!0?r.push(n===1?"1 solution, the only one.":`${n} solutions: these are all.`):s.complete===!1?r.push(`${n} solutions; there may be more.`):r.push("Solved."),n>ta&&r.push(`The first ${ta} are in the picture, and any that you point at.`),t?.closed_form&&!i&&r.push(`Closed form: ${t.closed_form}.`),r.join(" ")}var Bw=350,ig={id:"ik",title:"Inverse",open:(s,t)=>bc(s,t,()=>Vw(s,t))};function Vw(s,t){let{store:e,api:i,view:n}=t,r=new bi(i),o=new Ae,a=new Vc(r.api,e),l=new Xc({typed:y=>e.set({target:y}),nudged:y=>{a.follow(y),a.rest(Bw)},degrees:()=>e.value.degrees}),c=new Bc(e,()=>{a.solve()}),h=new qc(e,a),u=new Wc(e,a.outcome),d=n&&new Hc(n,e,a.outcome),f=n&&new Uc(n,e,{dragged:y=>a.follow(y),dropped:()=>a.rest()}),m=new _e("Dragging in the picture",[{value:"translate",text:"Move"},{value:"rotate",text:"Turn"}],y=>x(y)),x=y=>{let M=f?.turnTo(y)??y;m.show(M);for(let S of["translate","rotate"])m.allow(S,f?.allows(S)?null:"None of its directions counts")},p=new _e("Unit of angles",[{value:"rad",text:"rad"},{value:"deg",text:"deg"}],y=>e.set({degrees:y==="deg"})),g=Vt("Make it a rotation",()=>e.set({target:Ww(e.value.target,l)}),{hidden:!0}),_=P("p",{class:"muted small",title:"1 cm or 1° at a time, ten times as much with Shift"},`${f?"Drag it in the picture, or press":"Press"} ↑ or ↓ in a field: the robot follows.`);s.append(ai("Target",P("div",{class:"bar"},f&&m.host,...Gw(t,l),P("span",{class:"spring"}),p.host),l.host,_),ai("Solutions",c.host,o.host,g,h.host,u.host),r.host);let b=[Hw(t,l,a),e.watch(["model","base","tip","target","inverse"],({target:y})=>{y&&!a.outcome.value.isFollowing&&a.solve()}),e.watch(["target","degrees"],({target:y})=>y&&l.show(y)),e.watch(["model","base","tip","inverse","degrees"],y=>c.show(y)),e.watch(["model","base","tip","inverse"],()=>x(f?.mode??"translate")),e.watch(["degrees"],({degrees:y})=>p.show(y?"deg":"rad")),e.watch(["positions","degrees"],()=>u.show()),a.outcome.watch(["result"],()=>u.show()),a.outcome.watch(["result","isBusy","isFollowing","isCancelled"],()=>h.show()),a.outcome.watch(["problem"],({problem:y})=>{o.show(y),g.hidden=!y?.places.some(({pointer:M})=>M.startsWith("#/targets"))}),()=>a.cancel(),()=>h.close(),()=>d?.close(),()=>f?.close()];return()=>{for(let y of b)y()}}function Hw({store:s},t,e){let i="",n=null;return s.watch(["model","base","tip","target"],r=>{let o=ee(r);if(!o)return;let a=`${o.model.name} ${o.base} ${o.tip}`,l=i!==""&&a!==i&&n===r.target;a!==i&&e.forget(),i=a,n=r.target,(!r.target||l)&&(o.model.place(r.positions),s.set({target:di(o.model.pose(o.base,o.tip),t.format)}))})}function Gw({store:s},t){let e=()=>{let n=ee(s.value);n&&s.set({target:di(n.model.pose(n.base,n.tip),t.format)})},i=()=>{let n=ee(s.value);if(!n)return;let{model:r,base:o,tip:a}=n,{positions:l}=s.value;r.place(r.random(o,a,l));let c=r.pose(o,a);r.place(l),s.set({target:di(c,t.format)})};return[Vt("Here",e,{title:"Where the tip is now"}),Vt("Random",i,{title:"Where a random configuration within the limits brings the tip"})]}function Ww(s,t){return di(Yp(s),t.format)}function cd(s,t,e){let i=URL.createObjectURL(new Blob([e],{type:t}));P("a",{href:i,download:s}).click(),setTimeout(()=>URL.revokeObjectURL(i),1e4)}function ng(s,t){let{store:e}=s,i=P("div",{class:"about"}),n=e.watch(["model"],r=>{i.replaceChildren(),r.model&&i.append(...Xw(r.model),jw(r.model,s,t))});return{host:i,close:n}}function Xw(s){let t=s.info,i=[["Joints",`${s.joints.length} with a position of their own, ${s.links.length} links`],["Chain",`${s.ends.base_frame} → ${s.ends.tip_frame}`],["Licence",t?.licence],["Source",t?.provenance]].filter(([,r])=>r),n=t?.warnings??[];return[P("h3",{},s.title),P("p",{class:"muted"},t?.description??"A table that the service does not keep yet."),P("dl",{class:"facts"},...i.flatMap(([r,o])=>[P("dt",{},r),P("dd",{},o)])),...n.length?[qw(n)]:[]]}function qw(s){let t=`${s.length} ${s.length===1?"remark":"remarks"} on the description`;return P("details",{},P("summary",{},t),P("ul",{class:"remarks"},...s.map(e=>P("li",{},e))))}function jw(s,t,e){let{api:i,store:n}=t,r=l=>()=>{e.show(null),l().catch(c=>e.show(ze(c)))},o=s.name??"table",a=r(async()=>{await i.call({method:"DELETE",path:`v1/robots/${encodeURIComponent(s.name)}`}),n.set({robot:"panda",base:null,tip:null})});return P("div",{class:"bar"},Vt("Download URDF",()=>cd(`${o}.urdf`,"application/xml",s.urdf)),Vt("Download DH",r(async()=>cd(`${o}.dh.json`,"application/json",await Yw(s,t)))),P("span",{class:"spring"}),s.info?.source==="uploaded"&&Vt("Remove",a,{class:"button danger"}))}async function Yw(s,{api:t,store:e}){let{draft:i,base:n,tip:r,table:o}=e.value,a=i??o?.dh??(await t.get(qu(s.name,"standard",n,r))).dh;return`${JSON.stringify(a,null,2)}
`}function sg(s,{api:t,store:e}){let i=new AbortController,n=new Ae,r=P("ul",{class:"robots"}),o=P("p",{class:"muted small",role:"status"}),a=[],l=P("input",{type:"search",class:"search",placeholder:"Search by name or description","aria-label":"Search the robots",oninput:()=>c()}),c=()=>{let f=l.value.toLowerCase().split(/\s+/).filter(Boolean),m=a.filter(x=>f.every(p=>`${x.name} ${x.description} ${x.format}`.toLowerCase().includes(p)));o.textContent=f.length?`${m.length} of ${a.length} robots`:`${a.length} robots`,r.replaceChildren(...m.map(x=>Zw(x,e.value.robot,()=>h(x.name))))},h=f=>e.set({robot:f,draft:null,base:null,tip:null,target:null});s.append(l,o,r,n.host),(async()=>{try{a=(await t.get("v1/robots",i.signal)).robots,a.sort((f,m)=>f.source===m.source?0:f.source==="uploaded"?-1:1),c(),$w(r)}catch(f){i.signal.aborted||n.show(ze(f))}})();let d=e.watch(["robot"],({robot:f})=>{for(let m of r.querySelectorAll("button"))m.setAttribute("aria-current",String(m.dataset.robot===f))});return()=>{i.abort(),d()}}function $w(s){let t=s.querySelector("[aria-current=true]");t&&(s.scrollTop=t.offsetTop-s.offsetTop-s.clientHeight/2+t.offsetHeight/2)}function Zw(s,t,e){let i=[s.source==="uploaded"&&"uploaded",s.format==="dh"&&"DH"].filter(Boolean).join(", ");return P("li",{},P("button",{type:"button",class:"robot","data-robot":s.name,"aria-current":String(s.name===t),onclick:e},P("span",{class:"robot-name"},s.name,i&&P("span",{class:"mark"},i)),P("span",{class:"robot-description",title:s.description},s.description||"No description")))}var hd=null,ud=null;function Hi(s,t=!1){let e=P(t?"div":"span",{class:t?"formula display":"formula"}),i=n=>n.render(s,e,{displayMode:t,throwOnError:!1,output:"htmlAndMathml"});return hd?(i(hd),e):(ud??=import("./chunks/katex-Q6A3YYW3.js").then(n=>hd=n.default),ud.then(i).catch(()=>{ud=null,e.textContent=s}),e)}var rg={convention:"standard",joints:[{name:"joint_1",type:"revolute",a:0,alpha:1.5707963267948966,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_2",type:"revolute",a:.5,alpha:0,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_3",type:"revolute",a:.4,alpha:0,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793}]};var og={convention:"standard",joints:[{name:"joint_1",type:"revolute",a:0,alpha:1.5707963267948966,d:.3,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_2",type:"revolute",a:.5,alpha:0,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_3",type:"revolute",a:0,alpha:1.5707963267948966,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_4",type:"revolute",a:0,alpha:-1.5707963267948966,d:.4,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_5",type:"revolute",a:0,alpha:1.5707963267948966,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_6",type:"revolute",a:0,alpha:0,d:.1,theta:0,lower:-3.141592653589793,upper:3.141592653589793}]};var ag={convention:"modified",joints:[{name:"joint_1",type:"revolute",a:0,alpha:0,d:.333,theta:0,lower:-2.8973,upper:2.8973,velocity:2.175,effort:87},{name:"joint_2",type:"revolute",a:0,alpha:-1.5707963267948966,d:0,theta:0,lower:-1.7628,upper:1.7628,velocity:2.175,effort:87},{name:"joint_3",type:"revolute",a:0,alpha:1.5707963267948966,d:.316,theta:0,lower:-2.8973,upper:2.8973,velocity:2.175,effort:87},{name:"joint_4",type:"revolute",a:.0825,alpha:1.5707963267948966,d:0,theta:0,lower:-3.0718,upper:-.0698,velocity:2.175,effort:87},{name:"joint_5",type:"revolute",a:-.0825,alpha:-1.5707963267948966,d:.384,theta:0,lower:-2.8973,upper:2.8973,velocity:2.61,effort:12},{name:"joint_6",type:"revolute",a:0,alpha:1.5707963267948966,d:0,theta:0,lower:-.0175,upper:3.7525,velocity:2.61,effort:12},{name:"joint_7",type:"revolute",a:.088,alpha:1.5707963267948966,d:0,theta:0,lower:-2.8973,upper:2.8973,velocity:2.61,effort:12}],tool:{position:[0,0,.107],rpy:[0,0,0]}};var lg={convention:"standard",joints:[{name:"joint_1",type:"revolute",a:1,alpha:0,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_2",type:"revolute",a:.7,alpha:0,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793}]};var cg={convention:"standard",joints:[{name:"joint_1",type:"revolute",a:.5,alpha:0,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_2",type:"revolute",a:.4,alpha:0,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_3",type:"revolute",a:.3,alpha:0,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793}]};var hg={convention:"standard",joints:[{name:"joint_1",type:"revolute",a:0,alpha:1.5707963267948966,d:0,theta:0,lower:-2.792526803190927,upper:2.792526803190927},{name:"joint_2",type:"revolute",a:.4318,alpha:0,d:0,theta:0,lower:-.7853981633974483,upper:3.9269908169872414},{name:"joint_3",type:"revolute",a:.0203,alpha:-1.5707963267948966,d:.15005,theta:0,lower:-3.9269908169872414,upper:.7853981633974483},{name:"joint_4",type:"revolute",a:0,alpha:1.5707963267948966,d:.4318,theta:0,lower:-1.9198621771937625,upper:2.9670597283903604},{name:"joint_5",type:"revolute",a:0,alpha:-1.5707963267948966,d:0,theta:0,lower:-1.7453292519943295,upper:1.7453292519943295},{name:"joint_6",type:"revolute",a:0,alpha:0,d:0,theta:0,lower:-4.642575810304916,upper:4.642575810304916}]};var ug={convention:"standard",joints:[{name:"joint_1",type:"revolute",a:.325,alpha:0,d:.387,theta:0,lower:-1.8325957145940461,upper:1.8325957145940461},{name:"joint_2",type:"revolute",a:.275,alpha:3.141592653589793,d:0,theta:0,lower:-2.6179938779914944,upper:2.6179938779914944},{name:"joint_3",type:"prismatic",a:0,alpha:0,d:0,theta:0,lower:0,upper:.21},{name:"joint_4",type:"revolute",a:0,alpha:0,d:.05,theta:0,lower:-6.283185307179586,upper:6.283185307179586}]};var dg={convention:"standard",joints:[{name:"joint_1",type:"revolute",a:0,alpha:-1.5707963267948966,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_2",type:"revolute",a:0,alpha:1.5707963267948966,d:0,theta:0,lower:-3.141592653589793,upper:3.141592653589793},{name:"joint_3",type:"revolute",a:0,alpha:0,d:.1,theta:0,lower:-3.141592653589793,upper:3.141592653589793}]};var fg={convention:"standard",joints:[{name:"joint_1",type:"revolute",a:0,alpha:-1.5707963267948966,d:.412,theta:0,lower:-2.9670597283903604,upper:2.9670597283903604},{name:"joint_2",type:"revolute",a:0,alpha:1.5707963267948966,d:.154,theta:0,lower:-2.9670597283903604,upper:2.9670597283903604},{name:"joint_3",type:"prismatic",a:.0203,alpha:0,d:0,theta:-1.5707963267948966,lower:.30479999999999996,upper:1.27},{name:"joint_4",type:"revolute",a:0,alpha:-1.5707963267948966,d:0,theta:0,lower:-2.9670597283903604,upper:2.9670597283903604},{name:"joint_5",type:"revolute",a:0,alpha:1.5707963267948966,d:0,theta:0,lower:-1.5707963267948966,upper:1.5707963267948966},{name:"joint_6",type:"revolute",a:0,alpha:0,d:.263,theta:0,lower:-2.9670597283903604,upper:2.9670597283903604}]};var dd=[{title:"Planar arm, two joints",table:lg},{title:"Planar arm, three joints",table:cg},{title:"Anthropomorphic arm",table:rg},{title:"Spherical wrist",table:dg},{title:"Anthropomorphic arm with wrist",table:og},{title:"Stanford arm",table:fg},{title:"SCARA",table:ug},{title:"PUMA 560",table:hg},{title:"Panda, modified",table:ag}];var oM=[{value:"rpy",text:"Roll pitch yaw"},{value:"zyz",text:"Euler ZYZ"}],aM={position:["x","y","z"],rpy:["roll","pitch","yaw"],zyz:["φ","ϑ","ψ"]},jc=[{end:"base",title:"Base",latex:"T^{\\mathrm{base}}_{0}"},{end:"tool",title:"Tool",latex:"T^{n}_{\\mathrm{tool}}"}],Yc=class{host;#t;constructor(t,e){this.#t=jc.map(({end:i,title:n,latex:r})=>new fd(n,r,e,o=>t(i,o))),this.host=P("details",{class:"places"},P("summary",{},"Base and tool"),...this.#t.map(({host:i})=>i))}build(t){for(let[e,{end:i}]of jc.entries())this.#t[e].build(t[i]);(t.base||t.tool)&&this.host.setAttribute("open","")}fail(t){let e=n=>t.filter(({pointer:r})=>r.startsWith(`#/dh/${n}`));for(let[n,{end:r}]of jc.entries())this.#t[n].fail(e(r));let i=jc.flatMap(({end:n})=>e(n));return i.length&&this.host.setAttribute("open",""),t.filter(n=>!i.includes(n))}},fd=class{constructor(t,e,i,n){this.title=t;this.degrees=i;this.edited=n;this.#a=new _e(`Orientation of the ${t.toLowerCase()}`,oM,r=>{this.#e=r,this.#l()}),this.host=P("div",{class:"place"},P("div",{class:"bar"},P("span",{},`${t} `,Hi(e)),P("span",{class:"spring"}),this.#a.host),this.#r,this.#o)}title;degrees;edited;host;#t={};#e="rpy";#i=new Map;#n=new Map;#s=new Map;#r=P("div",{class:"place-fields"});#o=P("div",{class:"place-error",role:"alert",hidden:!0});#a;build(t={}){this.#t=t,(t.zyz||t.rpy)&&(this.#e=t.zyz?"zyz":"rpy"),this.#l()}fail(t){this.#s=new Map(t.map(({pointer:e,detail:i})=>[e.split("/").slice(3).join(" "),i])),this.#u()}#l(){this.#a.show(this.#e),this.#i.clear(),this.#n.clear(),this.#s.clear(),this.#r.replaceChildren(...this.#c("position"),...this.#c(this.#e)),this.#u()}#c(t){let e=t==="position"?"length":"angle",i=pg(this.#t,t);return[...aM[t].map((r,o)=>{let a=`${t} ${o}`,l=new Vi({label:`${this.title}, ${r}`,kind:e,degrees:this.degrees,live:!0,change:c=>this.#h(t,o,c),invalid:c=>{c===null?this.#n.delete(a):this.#n.set(a,c),this.#u()}});return l.set(i[o]),this.#i.set(a,l),P("span",{class:"detail"},r,l.input)}),P("span",{class:"unit"},Bi(e,this.degrees()))]}#h(t,e,i){let n=[...pg(this.#t,t)];n[e]=i,this.#t=t==="position"?lM(this.#t,n):{position:ks(Pe(this.#t)),[t]:n},this.#n.size===0&&this.edited(cM(this.#t)?void 0:this.#t)}#u(){let t=new Map([...this.#s,...this.#n]);for(let[i,n]of this.#i)n.fail(t.get(i)??null);this.#o.hidden=t.size===0;let e=i=>this.#i.get(i)?.input.getAttribute("aria-label")??this.title;this.#o.replaceChildren(...[...t].map(([i,n])=>P("p",{},`${e(i)}: ${n}`)))}};function pg(s,t){let e=s[t];if(e)return e;let i=Pe(s);return t==="position"?ks(i):di(i,t)[t]}function lM(s,t){return s.matrix?{matrix:s.matrix.map((i,n)=>n<3?[...i.slice(0,3),t[n]]:i)}:{...Object.keys(s).some(i=>i!=="position")?s:{rpy:[0,0,0]},position:t}}function cM(s){return Pe(s).elements.every((t,e)=>t===(e%5===0?1:0))}function mg(s,t){let e=Pe(s.base),i=[],n=e.clone();for(let[r,o]of s.joints.entries()){let a=n.clone(),[l,c]=xg(s,o,yg(o,r,t)),h=a.clone().multiply(l);n=h.clone().multiply(c);let[u,d,f]=[a,h,n].map(x=>new C().setFromMatrixPosition(x)),m=s.convention==="standard"?{d:[u,d],a:[d,f]}:{a:[u,d],d:[d,f]};i.push({T:n,...m})}return{first:e,rows:i,tool:n.clone().multiply(Pe(s.tool))}}function gg(s,t){return s.joints.map((e,i)=>{let[n,r]=xg(s,e,yg(e,i,t));return n.multiply(r)})}function xg(s,t,e){let i=t.theta+(t.type==="revolute"?e:0),n=t.d+(t.type==="prismatic"?e:0),r=new wt().makeRotationX(t.alpha).setPosition(t.a,0,0),o=new wt().makeRotationZ(i).setPosition(0,0,n);return s.convention==="standard"?[o,r]:[r,o]}function yg(s,t,e){return s.mimic?s.mimic.multiplier*(e[s.mimic.joint]??0)+s.mimic.offset:e[tn(s,t)]??0}function tn(s,t){return s.name??`joint_${t+1}`}var ea=[{name:"a",latex:"a_i",kind:"length"},{name:"alpha",latex:"\\alpha_i",kind:"angle"},{name:"d",latex:"d_i",kind:"length"},{name:"theta",latex:"\\theta_i",kind:"angle"},{name:"lower",latex:"q_{\\min}",kind:"joint"},{name:"upper",latex:"q_{\\max}",kind:"joint"}],pd={a:"a",alpha:"α",d:"d",theta:"θ",lower:"lower limit",upper:"upper limit",velocity:"velocity limit",effort:"effort limit",name:"name"},_g=new Set(["lower","upper","velocity","effort"]),hM=["name","velocity","effort"],$c=class{constructor(t,e,i){this.row=t;this.options=i;let n=e+1;this.#e=P("input",{class:"text",type:"text","aria-label":`Row ${n}, name`,autocomplete:"off",spellcheck:"false",placeholder:`joint_${n}`,onchange:()=>i.rename(this.#e.value)}),this.#e.value=tn(t,e),this.#i=this.#c(n),this.#n=P("tr",{class:"cell-error",hidden:!0}),this.hosts=[this.#l(n),this.#i,this.#n]}row;options;hosts;#t=new Map;#e;#i;#n;#s=new Map;#r=new Map;#o=!1;get isRead(){return this.#s.size===0}focus(){this.#t.get("a")?.input.focus()}detail(t){this.#o=t,this.#d()}refuse(t){this.#r=new Map(t),this.#d()}get#a(){return this.row.type==="revolute"?"angle":"length"}#l(t){let e=ea.map(({name:n,kind:r})=>{let o=this.#u(n,r==="joint"?this.#a:r,t),a=n===(this.row.type==="revolute"?"theta":"d");return P("td",{class:a?"variable":null,title:a?"The joint's position is added to this":null},o.input)}),i=Vt("×",this.options.remove,{class:"icon","aria-label":`Remove row ${t}`,title:"Remove",disabled:this.options.isOnly});return P("tr",{},P("th",{scope:"row"},String(t)),P("td",{},this.#h(t)),...e,P("td",{},i))}#c(t){let e=this.row.type==="revolute",i=`${Bi(this.#a,this.options.degrees())}/s`,n=(o,a,l)=>P("span",{class:"detail"},o,a,l&&P("span",{class:"unit"},l)),r=P("td",{colspan:ea.length+2},P("div",{class:"details"},n("Name",this.#e,""),n("Velocity",this.#u("velocity",this.#a,t).input,i),n("Effort",this.#u("effort","length",t).input,e?"N m":"N")));return P("tr",{class:"row-details",hidden:!0},P("td"),r)}#h(t){let{row:e}=this,i=P("select",{class:"select","aria-label":`Row ${t}, type`,onchange:()=>{e.type=i.value;for(let n of _g)delete e[n];this.options.retyped()}},P("option",{value:"revolute",selected:e.type==="revolute"},"R"),P("option",{value:"prismatic",selected:e.type==="prismatic"},"P"));return i}#u(t,e,i){let{row:n}=this,r=_g.has(t),o=new Vi({label:`Row ${i}, ${pd[t]}`,kind:e,degrees:this.options.degrees,decimals:3,live:!0,optional:r,change:a=>{a!==null?n[t]=a:r&&delete n[t],this.options.edited()},invalid:a=>{a===null?this.#s.delete(t):this.#s.set(t,a),this.#d()}});return o.set(n[t]??null),t==="lower"&&(o.input.placeholder=e==="angle"?"−π":"−1"),t==="upper"&&(o.input.placeholder=e==="angle"?"π":"1"),this.#t.set(t,o),o}#d(){let t=new Map([...this.#r,...this.#s]);for(let[i,n]of this.#t)n.fail(t.get(i)??null);this.#e.setAttribute("aria-invalid",String(t.has("name"))),this.#i.hidden=!this.#o&&!hM.some(i=>t.has(i)),this.#n.hidden=t.size===0;let e=[...t].map(([i,n])=>P("p",{},i in pd?`${pd[i]}: ${n}`:n));this.#n.replaceChildren(P("td",{colspan:ea.length+3,role:"alert"},...e))}};var Zc=class{constructor(t,e){this.edited=t;this.degrees=e;this.host=P("table",{class:"dh"},P("thead",{},this.#e),this.#t)}edited;degrees;host;#t=P("tbody");#e=P("tr");#i=[];#n=[];#s=!1;get isEmpty(){return this.#i.length===0}build(t){this.#n=structuredClone([...t]);let e=ea.map(({latex:n,kind:r})=>{let o=r==="joint"?"":Bi(r,this.degrees());return P("th",{scope:"col"},Hi(n),o&&P("span",{class:"unit"},o))}),i=n=>P("th",{scope:"col"},P("span",{class:"unseen"},n));this.#e.replaceChildren(i("Row"),i("Type"),...e,i("Remove")),this.#i=this.#n.map((n,r)=>this.#r(n,r)),this.#t.replaceChildren(...this.#i.flatMap(({hosts:n})=>n))}add(){let t=new Set(this.#n.map(tn)),e=this.#n.length+1;for(;t.has(`joint_${e}`);)e+=1;let i={name:`joint_${e}`,type:"revolute",a:.3,alpha:0,d:0,theta:0};this.#a([...this.#n,i]),this.#i.at(-1)?.focus()}detail(t){this.#s=t;for(let e of this.#i)e.detail(t)}fail(t){let e=this.#i.map(()=>new Map),i=[];for(let n of t){let[,r,o=""]=/^#\/dh\/joints\/(\d+)(?:\/([^/]+))?/.exec(n.pointer)??[],a=r===void 0?void 0:e[Number(r)];a?a.set(o,n.detail.replace(/^joint \d+ of the table: (?:\w+: )?/,"")):i.push(n)}for(let[n,r]of this.#i.entries())r.refuse(e[n]);return i}#r(t,e){let i=new $c(t,e,{degrees:this.degrees,isOnly:this.#n.length===1,edited:()=>this.#l(),retyped:()=>this.#a(this.#n),rename:n=>this.#o(e,n.trim()),remove:()=>this.#a(this.#n.filter((n,r)=>r!==e))});return i.detail(this.#s),i}#o(t,e){let i=this.#n[t],n=tn(i,t);e?i.name=e:delete i.name;for(let{mimic:r}of this.#n)r?.joint===n&&(r.joint=tn(i,t));this.#l()}#a(t){this.build(t),this.#l()}#l(){this.#i.every(t=>t.isRead)&&this.edited(structuredClone(this.#n))}};var uM=[{value:"standard",text:"Standard"},{value:"modified",text:"Modified"}],dM={standard:"A_i = R_z(\\theta_i)\\, T_z(d_i)\\, T_x(a_i)\\, R_x(\\alpha_i)",modified:"A_i = R_x(\\alpha_i)\\, T_x(a_i)\\, R_z(\\theta_i)\\, T_z(d_i)"},vg={convention:"standard",joints:[{name:"joint_1",type:"revolute",a:.5,alpha:0,d:0,theta:0}]};function bg(s,{api:t,store:e}){let i=new Ye,n=new Ae,r=P("div",{class:"product"}),o=null,a=b=>e.set({draft:b,robot:"",base:null,tip:null}),l=b=>{JSON.stringify(b)!==JSON.stringify(o)&&(o=b,a(b))},c=()=>e.value.degrees,h=new Zc(b=>l({...o,joints:b}),c),u=new Yc((b,y)=>{let{[b]:M,...S}=o;l(y?{...S,[b]:y}:S)},c),d=new _e("Convention",uM,b=>{f(b)}),f=async b=>{if(!(!o||b===o.convention))try{let y=await i.run(M=>t.post("v1/dh/convert",{dh:o,convention:b},M));y&&a(y.dh),n.show(null)}catch(y){m(ze(y))}},m=b=>{let y=u.fail(h.fail(b?.places??[]));n.show(b&&(y.length||b.places.length===0)?b:null)},x=fM(b=>a(structuredClone(b))),p=Ki("Names, velocity, effort","The joints' names, and their limits of velocity and effort",()=>{let b=p.getAttribute("aria-pressed")!=="true";p.setAttribute("aria-pressed",String(b)),h.detail(b)}),g=vc({api:t,store:e},()=>o);s.append(P("div",{class:"bar"},d.host,P("span",{class:"spring"}),x),r,h.host,P("div",{class:"bar"},Vt("Add a row",()=>h.add()),p),u.host,n.host,g),e.set({dh:!0});let _=[e.watch(["draft","table","degrees"],b=>{let y=b.draft??b.table?.dh??(b.model?null:vg);y&&((y!==o||h.isEmpty)&&(h.build(y.joints),u.build(y)),o=y,d.show(y.convention),r.replaceChildren(Hi(dM[y.convention])))}),e.watch(["failure"],({failure:b,draft:y})=>m(y?b:null)),()=>i.cancel()];return()=>{for(let b of _)b()}}function fM(s){let t=P("select",{class:"select","aria-label":"Start from a table of the course",onchange:()=>{let e=t.value==="new"?vg:dd[Number(t.value)]?.table;e&&s(e),t.value=""}},P("option",{value:""},"Start from …"),P("option",{value:"new"},"One row"),...dd.map(({title:e},i)=>P("option",{value:i},e)));return t}var Sg={id:"robot",title:"Robot",open:mM},pM=[{value:"catalogue",text:"Catalogue"},{value:"upload",text:"Upload"},{value:"table",text:"DH table"}],md="catalogue";function wg(s){md=s}function mM(s,t){let{store:e}=t,i=new bi(t.api),n=new Ae,r=P("div",{class:"part"}),o=ng({...t,api:i.api},n),a=()=>{},l=u=>{md=u,a(),r.replaceChildren(),c.show(u),a={catalogue:sg,upload:pm,table:bg}[u](r,{...t,api:i.api})},c=new _e("Where the robot comes from",pM,l);s.append(ai("Choose a robot",c.host,r),n.host,ai("On the screen",o.host),i.host),l(e.value.draft&&!fm()?"table":md);let h=[o.close,e.watch(["failure","draft"],({failure:u,draft:d})=>n.show(d?null:u)),e.watch(["robot","draft"],({robot:u,draft:d})=>{i.show(d?{method:"POST",path:"v1/dh/to-urdf",body:{name:"draft",dh:d}}:{method:"GET",path:`v1/robots/${encodeURIComponent(u)}`})})];return()=>{a();for(let u of h)u()}}var gM=300,Jc=class{constructor(t,e,i){this.api=t;this.store=e;this.listener=i}api;store;listener;#t=new Ye;#e=new Ye;#i=null;#n="";#s=0;follow(){let t=()=>{clearTimeout(this.#s),this.#s=window.setTimeout(()=>{this.ask()},gM)},e=[this.store.watch(["model","base","tip"],()=>{this.#r()}),this.store.watch(["writing"],()=>{this.ask()}),this.store.watch(["positions"],t),()=>clearTimeout(this.#s),()=>this.cancel()];return()=>e.forEach(i=>i())}cancel(){this.#t.cancel(),this.#e.cancel(),this.listener.busy(!1)}async ask(){let{positions:t,writing:e}=this.store.value;if(!this.#i)return;let{key:i,call:n}=xM(this.#i,t,e),r=JSON.stringify(n);r!==this.#n&&await this.#o(async()=>{let o=await this.#e.run(a=>this.api.post("v1/dh/derive",n,a));return o?(this.#n=r,this.listener.derived({table:n.dh,answer:o,positions:t,key:i}),!0):!1})}async#r(){this.#i=null,this.#e.cancel(),await this.#o(async()=>{let t=await this.#t.run(e=>gc(this.api,this.store.value,e));return t?(this.#i=t.dh,!0):!1}),await this.ask()}async#o(t){this.listener.busy(!0);try{if(!await t())return;this.listener.failed(null)}catch(e){this.listener.failed(ze(e))}this.listener.busy(!1)}};function xM(s,t,{part:e,notation:i,symbolic:n}){let r={dh:s,notation:i,symbolic:n,...e==="motion"?{dynamics:{}}:{}},o=[s.joints.map((a,l)=>t[tn(a,l)]??0)];return{key:JSON.stringify(r),call:{...r,joint_positions:o}}}var Tg=["v_x","v_y","v_z","omega_x","omega_y","omega_z"];function Kc(s,t,e){let i=gg(s,t),n=i.reduce((u,d)=>[...u,(u.at(-1)??new wt).clone().multiply(d)],[]),r=Pe(s.base),o=[r,...n.map(u=>r.clone().multiply(u))],a=o.at(-1).clone().multiply(Pe(s.tool)),l=s.joints.map((u,d)=>{let f=o[s.convention==="standard"?d:d+1];return yM(f,a,u.type==="revolute")}),c=[...l.map(u=>[...u.linear,...u.angular])],h=Tg.map((u,d)=>c.map(f=>f[d]));return{A:i.map(zs),T_0:n.map(zs),T_base_tool:zs(a),columns:l,jacobian:h,determinant:e&&vM(_M(h,o[e.frame],e.rows))}}function yM(s,t,e){let i=new C().setFromMatrixColumn(s,2),n=new C().setFromMatrixPosition(t).sub(new C().setFromMatrixPosition(s));return{axis:i.toArray(),arm:n.toArray(),linear:(e?i.clone().cross(n):i).toArray(),angular:e?i.toArray():[0,0,0]}}function _M(s,t,e){let i=zs(t);return e.map(n=>{let r=Tg.indexOf(n),o=r<3?0:3,a=r-o;return s[0].map((l,c)=>[0,1,2].reduce((h,u)=>h+i[u][a]*s[o+u][c],0))})}function vM(s){let t=s.map(i=>[...i]),e=1;for(let i=0;i<t.length;i+=1){let n=a=>Math.abs(a[i]),r=t.slice(i).reduce((a,l)=>n(l)>n(a)?l:a),o=t.indexOf(r);if(r[i]===0)return 0;o!==i&&([t[i],t[o]]=[r,t[i]],e=-e),e*=r[i];for(let a of t.slice(i+1)){let l=a[i]/r[i];for(let c=i;c<a.length;c+=1)a[c]=a[c]-l*r[c]}}return e}function Ag(s,t){let[e,i]=[Mg(s),Mg(t)];return e.length!==i.length?1/0:e.reduce((n,r,o)=>Math.max(n,Math.abs(r-i[o])),0)}function Mg({A:s,T_0:t,T_base_tool:e,columns:i,jacobian:n,determinant:r}){let o=i.flatMap(({axis:a,arm:l,linear:c,angular:h})=>[a,l,c,h]);return[s,t,e,o,n,r??[]].flat(3)}var bM=1e-9,Qc=class{host;#t=P("p",{class:"agreement",role:"status"});#e=P("dl",{class:"legend"});#i=P("details",{},P("summary",{},"Symbols"),this.#e);#n=P("ul",{class:"remarks"});#s="";constructor(){this.host=P("section",{class:"section",hidden:!0},this.#t,this.#i,this.#n)}show({table:t,answer:e,positions:i,key:n}){if(this.host.hidden=!1,this.#r(e,Ag(Kc(t,i,e.determinant),e.numeric[0])),n===this.#s)return;this.#s=n;let r=e.legend.flatMap(({latex:o,meaning_latex:a,value:l})=>[P("dt",{},Hi(o)),P("dd",{},Hi(l===null?a:`${a} = ${l}`))]);this.#e.replaceChildren(...r),this.#i.hidden=r.length===0,this.#n.replaceChildren(...e.notes.map(o=>P("li",{},o))),this.#n.hidden=e.notes.length===0}#r({certificate:t,numeric_certificate:e},i){let n=i<bM,r=t?` The formulas hold at ${t.samples} random configurations, to ${Qi(t.max_error)}.`:"";this.#t.dataset.tone=n?"good":"bad",this.#t.dataset.difference=String(i),this.#t.textContent=`The numbers here and the service's ${n?"agree":"differ"}: ${Qi(i)}; the service's and Pinocchio's: ${Qi(e?.max_jacobian_error??0)}.${r}`}};var SM=4,wM=1e-14,th=class{host;#t=[];constructor(t){this.host=P("span",{class:"matrix",role:"group","aria-label":t})}set(t){(t.length!==this.#t.length||t[0]?.length!==this.#t[0]?.length)&&this.#e(t);for(let[e,i]of t.entries())for(let[n,r]of i.entries()){let o=Eg(r),a=this.#t[e][n];a.textContent!==o&&(a.textContent=o)}}#e(t){this.host.classList.toggle("bracketed",t.flat().length>1),this.#t=t.map(e=>e.map(()=>P("span",{class:"matrix-cell"}))),this.host.replaceChildren(...this.#t.map(e=>P("span",{class:"matrix-row"},...e)))}};function Eg(s){let t=Math.abs(s-Math.round(s))<wM;return Si(s,t?0:SM)}function Rg(s){return`\\begin{bmatrix} ${s.map(e=>e.map(i=>Eg(i).replace("−","-")).join(" & ")).join(" \\\\ ")} \\end{bmatrix}`}var MM=500,TM="There is nothing to write down here; the remarks below say why.",eh=class{constructor(t){this.go=t}go;host=P("div",{class:"sheet"});#t=null;#e=[];#i=new ResizeObserver(t=>t.forEach(({target:e})=>AM(e)));show(t,e){this.clear(),this.host.replaceChildren(...t.map(i=>this.#n(i))),t.length||this.host.append(P("p",{class:"section muted"},TM)),this.update(e)}update(t){this.#t=t;for(let e of this.#e)e(t)}clear(){this.#i.disconnect(),this.#e=[],this.host.replaceChildren()}#n(t){let e=Dr(()=>EM(t,this.#t),`${t.title} as LaTeX`);return P("section",{class:"section step"},P("div",{class:"step-head"},P("h2",{},t.title),e),t.text&&P("p",{class:"muted small"},t.text),P("div",{class:"lines"},...t.lines.map(i=>this.#s(i))))}#s(t){let{name:e,numbers:i,example:n}=t,r=P("div",{class:"wide",role:"group","aria-label":e});this.#i.observe(r);let o=(t.latex?.length??0)>MM,a=P("div",{class:"line"},r);if(a.classList.toggle("large",o),a.classList.toggle("unbroken",o||i!==void 0),this.#r(t,r),i){let l=new th(`${e} in numbers`);this.#e.push(c=>l.set(i(c))),a.append(P("div",{class:"value"},P("span",{class:"approximately"},"≈"),l.host))}return n&&a.append(Vt("Go there",()=>this.go(n.positions),{class:"button small",title:`A configuration of this kind, ${n.title}`})),a}#r(t,e){if(!t.isLong){e.replaceChildren(Hi(Cg(t)));return}let i=Vt("Write it out",()=>this.#r({...t,isLong:!1},e),{class:"button small"});e.replaceChildren(Hi(t.symbol)," ",i)}};function Cg({symbol:s,latex:t}){return t===null||s===""?t??s:`${s} = ${t}`}function AM(s){s.scrollWidth>s.clientWidth?s.tabIndex=0:s.removeAttribute("tabindex")}function EM({title:s,text:t,lines:e},i){let n=e.map(r=>{let o=i&&r.numbers?` \\approx ${Rg(r.numbers(i))}`:"";return`\\[ ${Cg(r)}${o} \\]`});return[`\\paragraph{${s}}`,RM(t),...n].filter(Boolean).join(`
`)}function RM(s){return s.replace(/[_%&#$]/g,"\\$&").replaceAll("°","\\textdegree{}").replaceAll("×","$\\times$").replaceAll("…","\\dots{}")}var ih=[{value:"transforms",text:"DH and Aᵢ",titles:["Denavit-Hartenberg table","Transforms between neighbours"]},{value:"pose",text:"T⁰ᵢ",titles:["Position of the tip","Forward kinematics"]},{value:"jacobian",text:"Jacobian",titles:["Geometric Jacobian"]},{value:"singular",text:"Singularities",titles:["Determinant","Singular configurations"]},{value:"motion",text:"Motion",titles:[]}];function Ig(s,t){let e=new Set(ih.flatMap(({titles:r})=>r)),i=ih.find(({value:r})=>r===t).titles;return(i.length?i:s.steps.map(({title:r})=>r).filter(r=>!e.has(r))).map(r=>CM(s,r)).filter(({text:r,lines:o})=>r!==""||o.length>0)}function CM(s,t){let e=s.steps.find(n=>n.title===t),i=PM[t]?.(s,e?.latex??[])??Lg(e?.latex??[],t);return{title:t,text:e?.text??"",lines:i}}var PM={"Transforms between neighbours":({A:s},t)=>[...Lg(t.slice(0,1),"The rule"),...s.map((e,i)=>Ws(`A_{${i+1}}`,e,n=>n.A[i]))],"Forward kinematics":({T_0:s,T_base_tool:t})=>{let e=s.map((i,n)=>Ws(`T^{0}_{${n+1}}`,i,r=>r.T_0[n]));return t&&t.latex===s.at(-1)?.latex?e:[...e,Ws("T^{\\mathrm{base}}_{\\mathrm{tool}}",t??Pg("T_base_tool"),i=>i.T_base_tool)]},"Geometric Jacobian":({jacobian:s,joint_names:t,convention:e})=>{let i=o=>e==="standard"?o:o+1,n=s?.columns??[],r=Ws("J",s?.matrix??Pg("J"),o=>o.jacobian);return[...n.flatMap((o,a)=>LM(o,i(a),a)),...n.length?[IM(n,i)]:[],...t.length?[{...r,isLong:(r.latex?.length??0)>6e3}]:[]]},Determinant:({determinant:s},t)=>s&&(t.length||s.latex===null)?[{symbol:t.length?"":"\\det J",latex:t[0]??null,name:"Determinant",numbers:e=>[[e.determinant??NaN]]}]:[],"Singular configurations":({singularities:s},t)=>t.map((e,i)=>{let{example:n,example_singular_value:r}=s[i]??{},o={symbol:"",latex:e,name:`Singular configuration ${i+1}`};return n?{...o,example:{positions:n,title:`σ_min = ${r?.toExponential(1)??"0"}`}}:o})};function IM(s,t){let e=s.map(({arm:r},o)=>r?`z_{${t(o)}} \\times p_{${t(o)},E}`:`z_{${t(o)}}`),i=s.map(({arm:r},o)=>r?`z_{${t(o)}}`:"0");return{symbol:"J",latex:`\\begin{bmatrix} ${e.join(" & ")} \\\\ ${i.join(" & ")} \\end{bmatrix}`,name:"J by its columns"}}function LM({joint:s,axis:t,arm:e,linear:i},n,r){let o=`z_{${n}}`,a=h=>h.map(u=>[u]),l={...Ws(o,t,h=>a(h.columns[r].axis)),name:`z of ${s}`};if(!e)return[l];let c=`p_{${n},E}`;return[l,{...Ws(c,e,h=>a(h.columns[r].arm)),name:`p of ${s}`},{...Ws(`${o} \\times ${c}`,i,h=>a(h.columns[r].linear)),name:`z × p of ${s}`}]}function Ws(s,{name:t,latex:e},i){return{symbol:s,latex:e,name:t,numbers:i}}function Lg(s,t){return s.map((e,i)=>({symbol:"",latex:e,name:s.length>1?`${t}, ${i+1}`:t}))}function Pg(s){return{name:s,latex:null}}var Ng={id:"worked",title:"Worked solution",open:zM},NM=[{value:"short",text:"c₁₂"},{value:"full",text:"cos(q₁ + q₂)"}],DM=[{value:"symbols",text:"Symbols"},{value:"values",text:"Values"}];function zM(s,{api:t,store:e}){let i=M=>e.set({writing:{...e.value.writing,...M}}),n=new _e("Part of the solution",ih,M=>i({part:M})),r=new _e("Cosines and sines",NM,M=>i({notation:M})),o=new _e("Lengths",DM,M=>i({symbolic:M==="symbols"})),a=new bi(t),l=new Ae,c=new ss(e);c.host.classList.add("compact");let h=new Qc,u=P("p",{class:"muted",role:"status"}),d=Vt("Stop",()=>b.cancel(),{class:"button small",hidden:!0}),f=null,m="",x=M=>{let S=f.table.joints.map((v,w)=>[tn(v,w),M[w]]);e.set({positions:{...e.value.positions,...Object.fromEntries(S)}})},p=new eh(x),g=()=>{if(!f)return;let{positions:M,writing:S}=e.value,v=Kc(f.table,M,f.answer.determinant),w=`${S.part} ${f.key}`;w===m?p.update(v):p.show(Ig(f.answer,S.part),v),m=w},_=()=>{f=null,m="",p.clear(),h.host.hidden=!0},b=new Jc(a.api,e,{derived:M=>{f=M,g(),h.show(M)},failed:M=>{l.show(M),M&&_()},busy:M=>{u.textContent=M?"Working it out …":"",d.hidden=!M}});s.append(ai("Write down",n.host,P("div",{class:"bar"},r.host,o.host,P("span",{class:"spring"}),u,d)),P("details",{class:"posture",open:!0},P("summary",{},"Joints"),c.host),l.host,p.host,h.host,a.host);let y=[e.watch(["writing"],({writing:M})=>{n.show(M.part),r.show(M.notation),o.show(M.symbolic?"symbols":"values"),g()}),e.watch(["model","base","tip"],_),e.watch(["model","base","tip","degrees"],()=>c.build()),e.watch(["positions"],()=>{c.update(),g()}),b.follow(),()=>p.clear(),()=>e.set({joint:null})];return()=>{for(let M of y)M()}}var cs=[Sg,Sm,ig,Vm,Ng];var kM=[{key:"frames",text:"Frames",title:"The frame of every link"},{key:"axes",text:"Axes",title:"The axes of the joints"},{key:"names",text:"Names",title:"The names of the links"},{key:"dh",text:"DH frames",title:"The frames of the chain's DH table, with a and d"}];function zg(s,t){FM(s,t),OM(s.heading,t.store),UM(s.marks,t),s.tools.append(BM(t),P("a",{class:"tool",href:"docs"},"API"))}function FM({tabs:s,panel:t},e){let{store:i}=e,n=cs.map((o,a)=>Vt(o.title,()=>i.set({panel:o.id}),{class:"tab",role:"tab",id:`tab-${o.id}`,"aria-controls":"panel",onkeydown:c=>{let h={ArrowRight:1,ArrowLeft:-1}[c.key];if(!h)return;c.preventDefault();let u=(a+h+cs.length)%cs.length;i.set({panel:cs[u].id}),n[u].focus()}}));s.append(...n);let r=()=>{};i.watch(["panel"],({panel:o})=>{let a=cs.find(({id:l})=>l===o)??cs[0];r(),t.replaceChildren(),t.scrollTop=0,t.setAttribute("aria-labelledby",`tab-${a.id}`);for(let[l,c]of n.entries()){let h=cs[l]===a;c.setAttribute("aria-selected",String(h)),c.tabIndex=h?0:-1}r=a.open(t,e)})}function OM(s,t){let e=P("h1"),i=Vt("",()=>t.set({panel:"robot"}),{class:"robot-pick",title:"Choose another robot"});i.append(e);let n=Dg("Base frame",a=>t.set({base:a})),r=Dg("Tip frame",a=>t.set({tip:a})),o=P("p",{class:"status",role:"status"});s.append(i,P("span",{class:"chain"},n,P("span",{"aria-hidden":"true"},"→"),r),o),t.watch(["model"],({model:a})=>{if(a){e.textContent=a.title,document.title=`${a.title} · Gelenk`;for(let l of[n,r])l.replaceChildren(...a.links.map(c=>P("option",{value:c},c)))}}),t.watch(["model","base","tip"],a=>{let l=ee(a);l&&(n.value=l.base,r.value=l.tip)}),t.watch(["loading","failure"],({loading:a,failure:l})=>{o.textContent=a?"Loading …":l?"Not on the screen: the panel Robot says why.":""})}function Dg(s,t){let e=P("select",{class:"select plain","aria-label":s,title:s,onchange:()=>t(e.value)});return e}function UM(s,{store:t,view:e}){let i=kM.map(({key:n,text:r,title:o})=>{let a=Ki(r,o,()=>t.set({[n]:!t.value[n]}));return t.watch([n],l=>a.setAttribute("aria-pressed",String(l[n]))),a});s.append(...i),e&&s.append(Vt("Fit",()=>e.fit(),{class:"toggle",title:"Look at the whole robot (double click)"}))}function kg(s){let t=matchMedia("(prefers-color-scheme: dark)"),e=()=>{let{theme:i}=s.value;i==="auto"?delete document.documentElement.dataset.theme:document.documentElement.dataset.theme=i,s.set({dark:i==="auto"?t.matches:i==="dark"})};s.watch(["theme"],e),t.addEventListener("change",e)}function BM({store:s}){let t=Vt("",()=>s.set({theme:s.value.dark?"light":"dark"}),{class:"tool"});return s.watch(["dark"],({dark:e})=>{t.textContent=e?"Light":"Dark",t.title=`Change to ${e?"light":"dark"} colours`}),t}function Og(s,t){let e=(i,n)=>{let r=new Kt;s.scene.add(r);let o=()=>{};t.watch(["model","unit","dark",...i],a=>{os(r),o=n(r,a),o(),s.draw()}),t.watch(["positions"],()=>{o(),s.draw()})};e(["frames","names","base","tip"],VM),e(["axes","joint"],HM),e(["dh","table"],(i,{dh:n,table:r,model:o})=>n&&r&&o?GM(i,t):()=>{})}function VM(s,t){let e=ee(t),i=t.unit,n=[];if(!e)return()=>{};let{model:r,base:o,tip:a}=e;for(let l of r.links){let c=()=>r.link(l).matrixWorld,h=l===o||l===a;(t.frames||h)&&n.push(gd(s,qo(h?i:i*.6),c)),t.names&&n.push(gd(s,Bs(l,"link"),c))}return()=>n.forEach(l=>l())}function HM(s,t){let e=t.unit,i=[];for(let n of Object.values(t.model?.root.joints??{})){let r=n.name===t.joint;if(!(n.jointType!=="fixed"&&n.jointType!=="floating")||!(t.axes||r))continue;let a=n.axis.clone(),l=new Kt;l.add(Fr(a,e*1.5,e*(r?.045:.025),me("axis"))),l.add(rs(a.clone().multiplyScalar(-e*.9),new C,e*.015,me("axis"),.6)),i.push(gd(s,l,()=>n.matrixWorld))}return()=>i.forEach(n=>n())}function gd(s,t,e){return s.add(t),()=>zn(t,e())}function GM(s,t){let{model:e,table:i,unit:n}=t.value,r=n*.028,{dh:o,base:a}=i,l=Array.from({length:o.joints.length+1},()=>qo(n,["x","z"]));for(let[u,d]of l.entries())d.name=`DH frame ${u}`;let c=l.flatMap((u,d)=>[Fg("x",d),Fg("z",d)]);s.add(...l,...c.map(u=>u.object));let h=o.joints.map((u,d)=>({a:rs(new C,new C,r,me("dimension-a")),d:rs(new C,new C,r,me("dimension-d")),aName:Bs(`a${fn(d+1)}`,"dimension a"),dName:Bs(`d${fn(d+1)}`,"dimension d")}));for(let u of h)s.add(u.a,u.d,u.aName,u.dName);return()=>{zn(s,e.link(a).matrixWorld);let u=mg(o,t.value.positions);zn(l[0],u.first);for(let[f,m]of u.rows.entries()){zn(l[f+1],m.T);let x=h[f];for(let[p,g]of[["a","aName"],["d","dName"]])Zu(x[p],...m[p],r),x[g].visible=x[p].visible,x[g].position.copy(m[p][0]).lerp(m[p][1],.5)}let d=[u.first,...u.rows.map(f=>f.T)];for(let f of c){let m=n*1.15;f.object.position.set(f.axis==="x"?m:0,0,f.axis==="z"?m:0).applyMatrix4(d[f.i])}WM(c,n*.2)}}function Fg(s,t){return{axis:s,i:t,object:Bs("",s)}}function WM(s,t){let e=[];for(let i of s){let n=`${i.axis}${fn(i.i)}`,r=e.find(o=>o.axis===i.axis&&o.object.position.distanceTo(i.object.position)<t);i.object.visible=r===void 0,r?r.object.element.textContent+=` ${n}`:(i.object.element.textContent=n,e.push(i))}}var Ug={type:"change"},yd={type:"start"},Vg={type:"end"},nh=new on,Bg=new Ei,XM=Math.cos(70*_i.DEG2RAD),ke=new C,Mi=2*Math.PI,ie={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},xd=1e-6,sh=class extends Cs{constructor(t,e=null){super(t,e),this.state=ie.NONE,this.target=new C,this.cursor=new C,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:Zn.ROTATE,MIDDLE:Zn.DOLLY,RIGHT:Zn.PAN},this.touches={ONE:Jn.ROTATE,TWO:Jn.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new C,this._lastQuaternion=new Wt,this._lastTargetPosition=new C,this._quat=new Wt().setFromUnitVectors(t.up,new C(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Sr,this._sphericalDelta=new Sr,this._scale=1,this._panOffset=new C,this._rotateStart=new Rt,this._rotateEnd=new Rt,this._rotateDelta=new Rt,this._panStart=new Rt,this._panEnd=new Rt,this._panDelta=new Rt,this._dollyStart=new Rt,this._dollyEnd=new Rt,this._dollyDelta=new Rt,this._dollyDirection=new C,this._mouse=new Rt,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=jM.bind(this),this._onPointerDown=qM.bind(this),this._onPointerUp=YM.bind(this),this._onContextMenu=eT.bind(this),this._onMouseWheel=JM.bind(this),this._onKeyDown=KM.bind(this),this._onTouchStart=QM.bind(this),this._onTouchMove=tT.bind(this),this._onMouseDown=$M.bind(this),this._onMouseMove=ZM.bind(this),this._interceptControlDown=iT.bind(this),this._interceptControlUp=nT.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=ie.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(Ug),this.update(),this.state=ie.NONE}pan(t,e){this._pan(t,e),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let e=this.object.position;ke.copy(e).sub(this.target),ke.applyQuaternion(this._quat),this._spherical.setFromVector3(ke),this.autoRotate&&this.state===ie.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let i=this.minAzimuthAngle,n=this.maxAzimuthAngle;isFinite(i)&&isFinite(n)&&(i<-Math.PI?i+=Mi:i>Math.PI&&(i-=Mi),n<-Math.PI?n+=Mi:n>Math.PI&&(n-=Mi),i<=n?this._spherical.theta=Math.max(i,Math.min(n,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(i+n)/2?Math.max(i,this._spherical.theta):Math.min(n,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(ke.setFromSpherical(this._spherical),ke.applyQuaternion(this._quatInverse),e.copy(this.target).add(ke),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=ke.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new C(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new C(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=ke.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(nh.origin.copy(this.object.position),nh.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(nh.direction))<XM?this.object.lookAt(this.target):(Bg.setFromNormalAndCoplanarPoint(this.object.up,this.target),nh.intersectPlane(Bg,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>xd||8*(1-this._lastQuaternion.dot(this.object.quaternion))>xd||this._lastTargetPosition.distanceToSquared(this.target)>xd?(this.dispatchEvent(Ug),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?Mi/60*this.autoRotateSpeed*t:Mi/60/60*this.autoRotateSpeed}_getZoomScale(t){let e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){ke.setFromMatrixColumn(e,0),ke.multiplyScalar(-t),this._panOffset.add(ke)}_panUp(t,e){this.screenSpacePanning===!0?ke.setFromMatrixColumn(e,1):(ke.setFromMatrixColumn(e,0),ke.crossVectors(this.object.up,ke)),ke.multiplyScalar(t),this._panOffset.add(ke)}_pan(t,e){let i=this.domElement;if(this.object.isPerspectiveCamera){let n=this.object.position;ke.copy(n).sub(this.target);let r=ke.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/i.clientHeight,this.object.matrix),this._panUp(2*e*r/i.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/i.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/i.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let i=this.domElement.getBoundingClientRect(),n=t-i.left,r=e-i.top,o=i.width,a=i.height;this._mouse.x=n/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(Mi*this._rotateDelta.x/e.clientHeight),this._rotateUp(Mi*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(Mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-Mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(Mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-Mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),n=.5*(t.pageY+e.y);this._rotateStart.set(i,n)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),n=.5*(t.pageY+e.y);this._panStart.set(i,n)}}_handleTouchStartDolly(t){let e=this._getSecondPointerPosition(t),i=t.pageX-e.x,n=t.pageY-e.y,r=Math.sqrt(i*i+n*n);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let i=this._getSecondPointerPosition(t),n=.5*(t.pageX+i.x),r=.5*(t.pageY+i.y);this._rotateEnd.set(n,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(Mi*this._rotateDelta.x/e.clientHeight),this._rotateUp(Mi*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),n=.5*(t.pageY+e.y);this._panEnd.set(i,n)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let e=this._getSecondPointerPosition(t),i=t.pageX-e.x,n=t.pageY-e.y,r=Math.sqrt(i*i+n*n);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new Rt,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){let e=t.deltaMode,i={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:i.deltaY*=16;break;case 2:i.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(i.deltaY*=10),i}};function qM(s){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(s.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(s)&&(this._addPointer(s),s.pointerType==="touch"?this._onTouchStart(s):this._onMouseDown(s),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function jM(s){this.enabled!==!1&&(s.pointerType==="touch"?this._onTouchMove(s):this._onMouseMove(s))}function YM(s){switch(this._removePointer(s),this._pointers.length){case 0:this.domElement.releasePointerCapture(s.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(Vg),this.state=ie.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function $M(s){let t;switch(s.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case Zn.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(s),this.state=ie.DOLLY;break;case Zn.ROTATE:if(s.ctrlKey||s.metaKey||s.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(s),this.state=ie.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(s),this.state=ie.ROTATE}break;case Zn.PAN:if(s.ctrlKey||s.metaKey||s.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(s),this.state=ie.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(s),this.state=ie.PAN}break;default:this.state=ie.NONE}this.state!==ie.NONE&&this.dispatchEvent(yd)}function ZM(s){switch(this.state){case ie.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(s);break;case ie.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(s);break;case ie.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(s);break}}function JM(s){this.enabled===!1||this.enableZoom===!1||this.state!==ie.NONE||(s.preventDefault(),this.dispatchEvent(yd),this._handleMouseWheel(this._customWheelEvent(s)),this.dispatchEvent(Vg))}function KM(s){this.enabled!==!1&&this._handleKeyDown(s)}function QM(s){switch(this._trackPointer(s),this._pointers.length){case 1:switch(this.touches.ONE){case Jn.ROTATE:if(this.enableRotate===!1){this.state=ie.NONE;break}this._handleTouchStartRotate(s),this.state=ie.TOUCH_ROTATE;break;case Jn.PAN:if(this.enablePan===!1){this.state=ie.NONE;break}this._handleTouchStartPan(s),this.state=ie.TOUCH_PAN;break;default:this.state=ie.NONE}break;case 2:switch(this.touches.TWO){case Jn.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(s),this.state=ie.TOUCH_DOLLY_PAN;break;case Jn.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(s),this.state=ie.TOUCH_DOLLY_ROTATE;break;default:this.state=ie.NONE}break;default:this.state=ie.NONE}this.state!==ie.NONE&&this.dispatchEvent(yd)}function tT(s){switch(this._trackPointer(s),this.state){case ie.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(s),this.update();break;case ie.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(s),this.update();break;case ie.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(s),this.update();break;case ie.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(s),this.update();break;default:this.state=ie.NONE}}function eT(s){this.enabled!==!1&&s.preventDefault()}function iT(s){s.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function nT(s){s.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var sT=new C(1.05,-1.35,.75).normalize(),Hg=20,rh=class{scene=new _s;camera=new Ce(35,1,.01,100);controls;canvas;unit=.1;#t;#e=new Rc;#i=null;#n=new Kt;#s={level:0,cell:.1};#r=!1;#o=!1;constructor(t){this.#t=new $l({antialias:!0}),this.#t.setPixelRatio(Math.min(window.devicePixelRatio,2)),this.canvas=this.#t.domElement,this.canvas.tabIndex=0,this.canvas.setAttribute("role","img"),this.canvas.setAttribute("aria-label","The robot in space. Arrow keys turn the view, plus and minus zoom."),this.#e.domElement.className="labels",this.#e.domElement.setAttribute("aria-hidden","true"),t.append(this.canvas,this.#e.domElement),this.camera.up.set(0,0,1),this.controls=new sh(this.camera,this.canvas),this.controls.addEventListener("change",()=>this.draw()),this.controls.addEventListener("start",()=>this.#o=!0),this.canvas.addEventListener("keydown",e=>this.#h(e)),this.canvas.addEventListener("dblclick",()=>this.fit()),this.#a(),this.scene.add(this.#n),new ResizeObserver(()=>this.#c(t)).observe(t),this.#c(t),this.dress()}show(t){let e=this.#i;this.#i=t,this.scene.add(t.root);let i=e!==null&&e.name===t.name;e&&e!==t&&oT(e.root),i||(this.#o=!1),this.settle()}settle(){this.#o||this.fit(),this.draw()}fit(){if(!this.#i)return;this.#o=!1;let t=rT(this.#i),e=Math.max(t.getSize(new C).length(),.05),i=t.getCenter(new C);Math.abs(e*.09-this.unit)>.15*this.unit&&(this.unit=e*.09);let n=e*.62/Math.tan(this.camera.fov*Math.PI/360)/Math.min(1,this.camera.aspect);this.camera.near=e/200,this.camera.far=e*60,this.controls.target.copy(i),this.camera.position.copy(i).addScaledVector(sT,n),this.camera.updateProjectionMatrix(),this.controls.update(),this.#l(t,e)}dress(){this.scene.background=me("view"),this.#l(null,0),this.draw()}draw(){this.#r||(this.#r=!0,requestAnimationFrame(()=>{this.#r=!1,this.#t.render(this.scene,this.camera),this.#e.render(this.scene,this.camera)}))}countMeshes(){let t=0;return this.#i?.root.traverse(e=>t+=e instanceof st?1:0),t}#a(){let t=new $n(16777215,1.9);t.position.set(2,-3,5);let e=new $n(16777215,.5);e.position.set(-3,2,1),this.scene.add(new yo(16777215,12105920,1.1),new Es(16777215,.25),t,e)}#l(t,e){if(t){let r=10**Math.floor(Math.log10(e/4)),o=[1,2,5,10].map(a=>a*r).find(a=>a>=e/8)??r;this.#s={level:t.min.z<-.02*e?t.min.z:0,cell:o}}for(let r of this.#n.children)r.dispose();this.#n.clear();let i=this.#s.cell*Hg,n=new wo(i,Hg,me("grid-strong"),me("grid"));n.rotation.x=Math.PI/2,n.position.z=this.#s.level,this.#n.add(n)}#c(t){let{clientWidth:e,clientHeight:i}=t;!e||!i||(this.camera.aspect=e/i,this.camera.updateProjectionMatrix(),this.#t.setSize(e,i),this.#e.setSize(e,i),this.settle())}#h(t){let e={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,-1],ArrowDown:[0,1]},i={"+":.9,"=":.9,"-":1/.9},n=this.camera.position.clone().sub(this.controls.target);if(t.key==="Home")this.fit();else if(i[t.key])n.multiplyScalar(i[t.key]);else if(e[t.key]){let[r,o]=e[t.key],a=Math.acos(n.z/n.length())+o*.1;if(n.applyAxisAngle(this.camera.up,r*.12),a>.05&&a<Math.PI-.05){let l=new C().crossVectors(this.camera.up,n).normalize();n.applyAxisAngle(l,o*.1)}}else return;t.preventDefault(),t.key!=="Home"&&(this.#o=!0,this.camera.position.copy(this.controls.target).add(n),this.controls.update(),this.draw())}};function rT(s){let t=new Yi().setFromObject(s.root),e=new C;for(let i of s.links)t.expandByPoint(e.setFromMatrixPosition(s.link(i).matrixWorld));return t}function oT(s){s.removeFromParent(),s.traverse(t=>{if(t instanceof st){t.geometry.dispose();for(let e of[t.material].flat())e.map?.dispose(),e.dispose()}})}var Xs=s=>document.getElementById(s);function aT(){let{linked:s,positions:t}=Uu(location.hash),e=new Br(Pd(s)),i=new tc(new URL(".",document.baseURI));kg(e);let n=lT(Xs("view")),r={store:e,api:i,view:n},o=()=>n&&e.set({unit:n.unit}),a=new xc(i,e,()=>{n?.settle(),o(),e.set({meshes:e.value.meshes+1})});e.watch(["positions"],({model:l,positions:c})=>l?.place(c)),e.watch(["model"],({model:l})=>{l&&n?.show(l),o()}),n&&(e.watch(["dark"],()=>n.dress()),Og(n,e)),zg({tabs:Xs("tabs"),panel:Xs("panel"),heading:Xs("heading"),marks:Xs("marks"),tools:Xs("tools")},r),a.follow(t),Zp(e,l=>{a.startAt(l.positions);let{robot:c,draft:h}=e.value,u=l.linked.robot===c&&JSON.stringify(l.linked.draft)===JSON.stringify(h);e.set(u?{...l.linked,robot:c,draft:h}:l.linked);let{model:d}=e.value;u&&d&&e.set({positions:d.complete(l.positions,d.ends.base_frame,d.ends.tip_frame)})}),mm(Xs("drop"),()=>{wg("upload"),e.set({panel:""}),e.set({panel:"robot"})}),Object.assign(globalThis,{studio:r})}function lT(s){try{return new rh(s)}catch{return s.append(P("p",{class:"no-view"},"This browser shows no 3-D pictures (WebGL is off). The numbers work all the same.")),null}}aT();
